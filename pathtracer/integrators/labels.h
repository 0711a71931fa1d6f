#pragma once

#include <guiding/schedule.h>
#include <guiding/settings.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "integrators/render.h"

/// The one table of names of each enumeration that people write: in settings files, on the command line, in reports.
namespace pt {

template <class Enum>
struct Labels;

template <>
struct Labels<guiding::DirectionMap> {
  static constexpr std::array<std::pair<guiding::DirectionMap, std::string_view>, 2> kTable{{
      {guiding::DirectionMap::Cylinder, "cylinder"},
      {guiding::DirectionMap::Octahedral, "octahedral"},
  }};
};

template <>
struct Labels<guiding::LearningTarget> {
  static constexpr std::array<std::pair<guiding::LearningTarget, std::string_view>, 2> kTable{{
      {guiding::LearningTarget::Radiance, "radiance"},
      {guiding::LearningTarget::Product, "product"},
  }};
};

template <>
struct Labels<guiding::SpatialFilter> {
  static constexpr std::array<std::pair<guiding::SpatialFilter, std::string_view>, 2> kTable{{
      {guiding::SpatialFilter::Nearest, "nearest"},
      {guiding::SpatialFilter::StochasticBox, "stochasticBox"},
  }};
};

template <>
struct Labels<guiding::DirectionalFilter> {
  static constexpr std::array<std::pair<guiding::DirectionalFilter, std::string_view>, 2> kTable{{
      {guiding::DirectionalFilter::Nearest, "nearest"},
      {guiding::DirectionalFilter::Box, "box"},
  }};
};

template <>
struct Labels<guiding::FractionMode> {
  static constexpr std::array<std::pair<guiding::FractionMode, std::string_view>, 3> kTable{{
      {guiding::FractionMode::Fixed, "fixed"},
      {guiding::FractionMode::Adam, "adam"},
      {guiding::FractionMode::Fit, "fit"},
  }};
};

template <>
struct Labels<guiding::FractionLoss> {
  static constexpr std::array<std::pair<guiding::FractionLoss, std::string_view>, 2> kTable{{
      {guiding::FractionLoss::KullbackLeibler, "kl"},
      {guiding::FractionLoss::Variance, "variance"},
  }};
};

template <>
struct Labels<guiding::CompensationForm> {
  static constexpr std::array<std::pair<guiding::CompensationForm, std::string_view>, 3> kTable{{
      {guiding::CompensationForm::None, "none"},
      {guiding::CompensationForm::WaterFilling, "uniform"},
      {guiding::CompensationForm::ClipRenormalise, "clip"},
  }};
};

template <>
struct Labels<guiding::SampleCombination> {
  static constexpr std::array<std::pair<guiding::SampleCombination, std::string_view>, 3> kTable{{
      {guiding::SampleCombination::Discard, "discard"},
      {guiding::SampleCombination::Automatic, "automatic"},
      {guiding::SampleCombination::InverseVariance, "inverseVariance"},
  }};
};

template <>
struct Labels<OpenPglModel> {
  static constexpr std::array<std::pair<OpenPglModel, std::string_view>, 3> kTable{{
      {OpenPglModel::ParallaxVmm, "parallaxVmm"},
      {OpenPglModel::Vmm, "vmm"},
      {OpenPglModel::Quadtree, "quadtree"},
  }};
};

template <>
struct Labels<MisHeuristic> {
  static constexpr std::array<std::pair<MisHeuristic, std::string_view>, 4> kTable{{
      {MisHeuristic::Balance, "balance"},
      {MisHeuristic::Power, "power"},
      {MisHeuristic::Cutoff, "cutoff"},
      {MisHeuristic::Maximum, "maximum"},
  }};
};

template <>
struct Labels<EnvironmentForm> {
  static constexpr std::array<std::pair<EnvironmentForm, std::string_view>, 4> kTable{{
      {EnvironmentForm::Plain, "plain"},
      {EnvironmentForm::Mean, "mean"},
      {EnvironmentForm::WaterFilling, "waterfill"},
      {EnvironmentForm::Normal, "normal"},
  }};
};

template <>
struct Labels<Allocation> {
  static constexpr std::array<std::pair<Allocation, std::string_view>, 9> kTable{{
      {Allocation::Fixed, "fixed"},
      {Allocation::SecondOrder, "secondOrder"},
      {Allocation::Convex, "convex"},
      {Allocation::ConvexControl, "convexControl"},
      {Allocation::InverseVariance, "inverseVariance"},
      {Allocation::EqualCountDeviation, "equalCountDeviation"},
      {Allocation::EqualCountMoment, "equalCountMoment"},
      {Allocation::Representativity, "representativity"},
      {Allocation::Population, "population"},
  }};
};

template <>
struct Labels<DirectEstimator> {
  static constexpr std::array<std::pair<DirectEstimator, std::string_view>, 4> kTable{{
      {DirectEstimator::MultiSample, "multiSample"},
      {DirectEstimator::OneSample, "oneSample"},
      {DirectEstimator::Optimal, "optimal"},
      {DirectEstimator::OptimalDirect, "optimalDirect"},
  }};
};

template <>
struct Labels<SamplerKind> {
  static constexpr std::array<std::pair<SamplerKind, std::string_view>, 2> kTable{{
      {SamplerKind::Independent, "independent"},
      {SamplerKind::Sobol, "sobol"},
  }};
};

template <>
struct Labels<ReconstructionFilter> {
  static constexpr std::array<std::pair<ReconstructionFilter, std::string_view>, 3> kTable{{
      {ReconstructionFilter::Box, "box"},
      {ReconstructionFilter::Tent, "tent"},
      {ReconstructionFilter::Gaussian, "gaussian"},
  }};
};

template <class Enum>
std::string_view labelOf(Enum value) {
  for (const auto& [e, label] : Labels<Enum>::kTable)
    if (e == value) return label;
  return "?";
}

/// Null if no value has that name.
template <class Enum>
const Enum* valueOfLabel(std::string_view text) {
  for (const auto& [e, label] : Labels<Enum>::kTable)
    if (label == text) return &e;
  return nullptr;
}

template <class Enum>
std::vector<std::string> labelsOf() {
  std::vector<std::string> labels;
  for (const auto& [e, label] : Labels<Enum>::kTable) labels.emplace_back(label);
  return labels;
}

}  // namespace pt
