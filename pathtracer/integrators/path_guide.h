#pragma once

#include <guiding/field.h>
#include <guiding/sample.h>

#include <memory>
#include <optional>
#include <span>

#include "integrators/path_loop.h"
#include "integrators/render.h"
#include "scene/scene.h"

namespace pt {

/// What a render learns from its own paths, and guides them with. Trained as guiding::Field is, whose comments say what
/// the calls mean; failures are thrown as WorkError.
class PathGuide {
 public:
  virtual ~PathGuide() = default;

  virtual void learn(std::span<const guiding::SampleBuffer> buffers) = 0;
  virtual void endIteration(double spp) = 0;
  virtual bool hasGuide() const noexcept = 0;

  /// The loop that traces with this guide on `workers` threads, until the next endIteration(). Called once in an
  /// iteration, so the choice between kinds of guides costs nothing per vertex.
  virtual std::unique_ptr<PathLoop> makeLoop(const Scene& scene, const RenderSettings& settings, int workers) const = 0;

  /// Heap bytes of what was learned.
  virtual std::size_t memoryBytes() const = 0;
  /// Ends the guide and hands out its field; none if it is of another kind.
  virtual std::optional<guiding::Field> takeField() { return std::nullopt; }
};

/// An untrained guide over the scene. Throws InputError for settings that cannot be used.
std::unique_ptr<PathGuide> makeGuide(const Scene& scene, const GuidingSettings& settings);

/// A guide that goes on from a field that was trained on this scene. Throws InputError if it was trained on another.
std::unique_ptr<PathGuide> pretrainedGuide(guiding::Field field, const Scene& scene);

std::unique_ptr<PathLoop> unguidedLoop(const Scene& scene, const RenderSettings& settings);

}  // namespace pt
