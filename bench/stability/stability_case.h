#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "integrators/render.h"
#include "scene/scene_description.h"

namespace bench {

/// A way to render that every case is tried with.
struct StabilityVariant {
  std::string name;
  std::optional<pt::GuidingSettings> guiding;  ///< none: unguided, what the others are held against
};

// ---------------------------------------------------------------- what a picture must come to

/// Nothing is known: the variants must agree with the unguided one.
struct AsUnguided {};

/// Every pixel's radiance.
struct KnownRadiance {
  double value = 0;
};

/// The sum of other scenes' pictures, rendered unguided, each times a factor.
struct AsOtherScenes {
  struct Part {
    pt::SceneDescription scene;
    double factor = 1;
  };
  std::vector<Part> parts;
};

/// No picture: the scene is refused with a message that contains this.
struct Refused {
  std::string message;
};

using StabilityTruth = std::variant<AsUnguided, KnownRadiance, AsOtherScenes, Refused>;

/// How the pictures of a case are made.
struct StabilityRenders {
  int runs = 12;            ///< independent ones of each variant
  std::int64_t spp = 127;   ///< seven iterations
  double tolerance = 1e-5;  ///< relative difference from the truth that is rounding, or stated physics, and no bias
  void (*adjust)(pt::RenderSettings&) = nullptr;  ///< may be null
  bool flushSubnormals = false;                   ///< take subnormal numbers for zero; not where the truth is rendered
  bool traps = false;                             ///< count floating-point exceptions
};

// ---------------------------------------------------------------- cases without a picture

/// What a probe found; `fault` empty: all is well.
struct ProbeResult {
  std::string fault = {};
  std::string figures = {};           ///< measured, for the table
  std::uint64_t dropped = 0;          ///< records refused
  std::size_t memoryBytes = 0;        ///< of the field
  std::optional<double> zScore = {};  ///< of a known mean
};

/// One entry of the suite. A case that renders has `scene`; one that looks into the library has `probe`.
struct StabilityCase {
  std::string name;         ///< "group/what"
  std::string expectation;  ///< what must come out, in words
  std::function<pt::SceneDescription()> scene = {};
  StabilityTruth truth = {};
  StabilityRenders renders = {};
  std::function<ProbeResult(const StabilityVariant&)> probe = {};
  bool probesUnguided = false;  ///< the probe is for the unguided variant too
  bool isFast = true;           ///< part of --fast
  bool rejects = false;         ///< samples leave the range of float here, and must be counted
  std::string knownLoss = {};   ///< why the guide's error may exceed 1.1 times the unguided error
  std::string heavyTail =
      {};  ///< why the bias z means nothing here: the variance is not finite, or not found by so few
};

/// All cases, in the order of the table. A new one is one more entry in a file of bench/stability/cases.
std::vector<StabilityCase> stabilityCases();

/// The variants, the unguided one first.
std::vector<StabilityVariant> stabilityVariants();

}  // namespace bench
