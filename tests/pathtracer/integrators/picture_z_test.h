#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrators/render.h"
#include "statistics/z_test.h"

/// Whether pictures agree with those of another renderer within the noise of both, pixel by pixel.
namespace test {

/// Mean and variance of independent renders, for each channel of each pixel.
struct NoisyPicture {
  int width = 0, height = 0;
  std::vector<RunningMean> channels;  ///< three a pixel

  pt::Image mean() const;
};

/// The renders differ in their seeds, 0 to runs - 1.
NoisyPicture renderRuns(const pt::Scene& scene, pt::RenderSettings settings, int runs);

/// A picture by another renderer: mean, and variance of one sample, of `spp` samples a pixel.
struct ReferencePicture {
  pt::Image mean, variance;
  double spp = 0;
  double rounding = 0;  ///< relative error of the mean that is no noise
};

struct PictureZTest {
  bool passed = false;
  double share = 0;  ///< of channels whose means agree
  pt::Image failed;  ///< the picture, darkened, with 1 in each channel that differs
  pt::Image z;       ///< difference in standard errors
  std::string message;
};

/// Tests each channel of each pixel at a level such that all of them pass with probability 0.99 [Sidak 1967] if the
/// means are equal. Passed if 99.75% do: the few others are left to fireflies, whose variance a finite number of
/// samples does not show. `leftOut` pixels are not compared.
PictureZTest zTestPicture(const NoisyPicture& ours, const ReferencePicture& reference);

/// Writes name-ours.exr, name-reference.exr, name-failed.exr and name-z.exr; returns the folder.
std::filesystem::path writeErrorPictures(const std::string& name, const NoisyPicture& ours,
                                         const ReferencePicture& reference, const PictureZTest& result);

}  // namespace test
