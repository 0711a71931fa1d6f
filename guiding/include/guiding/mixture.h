#pragma once

#include <ImathVec.h>

#include <concepts>
#include <limits>

#include "guiding/distribution.h"

namespace guiding {

/// Value and density of a BSDF for one pair of directions. Delta lobes take no part.
template <class Color>
struct BsdfEvaluation {
  Color bsdfCos;  ///< BSDF * |cos|
  float pdf = 0;  ///< density with which the BSDF's own sampler draws wi, per solid angle, its lobe choice included
};

/// A direction drawn by the BSDF's own sampler.
template <class Color>
struct BsdfDraw {
  Imath::V3f wi;
  Color weight;   ///< BSDF * |cos| / pdf (for a delta lobe its throughput weight)
  float pdf = 0;  ///< per solid angle; for a delta lobe the probability of choosing it; 0: the sample failed, and
                  ///< neither direction nor weight mean anything
  bool isDelta = false;
};

/// The outcome of one-sample MIS.
template <class Color>
struct MixtureDraw {
  Imath::V3f wi;
  Color weight;   ///< throughput weight: BSDF * |cos| / mixturePdf; black: the path ends
  Color bsdfCos;  ///< BSDF * |cos|; for a delta event the lobe's weight * probability
  float pdf = 0;  ///< alpha * bsdfPdf + (1 - alpha) * guidePdf, per solid angle; for a delta event alpha *
                  ///< probability; 0: the sample failed, its weight is black
  float bsdfPdf = 0;
  float guidePdf = 0;
  bool isDelta = false;
  bool fromGuide = false;
};

/// What the mixture asks of a host's BSDF at one shading point (world space directions).
template <class B>
concept HostBsdf = requires(const B& bsdf, Imath::V3f wi, float uLobe, Imath::V2f u) {
  typename B::Color;
  { bsdf.evaluate(wi) } -> std::same_as<BsdfEvaluation<typename B::Color>>;
  { bsdf.sample(uLobe, u) } -> std::same_as<BsdfDraw<typename B::Color>>;
};

/// What the mixture asks of a guide at one shading point. Any density over directions will do; the meaning of the
/// members is that of GuidingDistribution's.
template <class G>
concept Guide = requires(const G& guide, Imath::V3f wi, Imath::V2f u) {
  static_cast<bool>(guide);
  { guide.bsdfSamplingFraction() } -> std::same_as<float>;
  { guide.sample(u) } -> std::same_as<DirectionSample>;
  { guide.pdf(wi) } -> std::same_as<float>;
};

/// Density of wi under the mixture, for MIS against light sampling. `bsdfPdf` is the BSDF sampler's own density of wi.
template <Guide G = GuidingDistribution>
float mixturePdf(const G& guide, float bsdfPdf, const Imath::V3f& wi) noexcept {
  if (!guide) return bsdfPdf;
  const float alpha = guide.bsdfSamplingFraction();
  return alpha * bsdfPdf + (1 - alpha) * guide.pdf(wi);
}

/// One-sample MIS of a BSDF and the guide under the balance heuristic [Veach & Guibas 1995, Sec. 5.2].
///
/// The direction that is returned is the truth: both densities are those of that very float direction. Without a guide
/// this is plain BSDF sampling. uChoice in [0,1) chooses the technique and is rescaled for reuse.
template <HostBsdf B, Guide G = GuidingDistribution>
MixtureDraw<typename B::Color> sampleMixture(const B& bsdf, const G& guide, float uChoice,
                                             const Imath::V2f& u) noexcept {
  using Color = typename B::Color;
  MixtureDraw<Color> draw{.wi = {0, 0, 1}, .weight = Color(0.0f), .bsdfCos = Color(0.0f)};
  const float alpha = guide ? guide.bsdfSamplingFraction() : 1.0f;

  if (uChoice < alpha) {
    const auto b = bsdf.sample(uChoice / alpha < 1 ? uChoice / alpha : 0x1.fffffep-1f, u);
    if (!(b.pdf > 0)) return draw;
    draw.wi = b.wi;
    draw.isDelta = b.isDelta;
    draw.bsdfPdf = b.pdf;
    if (b.isDelta || !guide) {  // the guide cannot produce a delta direction
      draw.pdf = alpha * b.pdf;
      draw.weight = b.weight * (1 / alpha);
      draw.bsdfCos = b.weight * b.pdf;
      return draw;
    }
    draw.guidePdf = guide.pdf(b.wi);
    draw.pdf = alpha * b.pdf + (1 - alpha) * draw.guidePdf;
    draw.bsdfCos = b.weight * b.pdf;
  } else {
    const DirectionSample g = guide.sample(u);
    if (!(g.pdf > 0)) return draw;
    const auto e = bsdf.evaluate(g.wi);
    draw.wi = g.wi;
    draw.fromGuide = true;
    draw.guidePdf = g.pdf;
    draw.bsdfPdf = e.pdf;
    draw.pdf = alpha * e.pdf + (1 - alpha) * g.pdf;
    draw.bsdfCos = e.bsdfCos;
  }
  // Below the smallest normal number the reciprocal is infinite.
  if (draw.pdf >= std::numeric_limits<float>::min()) draw.weight = draw.bsdfCos * (1 / draw.pdf);
  return draw;
}

}  // namespace guiding
