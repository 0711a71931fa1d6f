#include "reference/reference.h"
#include "results/metric.h"

namespace bench {

namespace {

/// Mean of the parts whose index has the given remainder modulo `modulus`.
pt::Image meanOf(const std::vector<pt::Image>& parts, std::size_t remainder, std::size_t modulus) {
  pt::Image mean(parts.front().width, parts.front().height);
  std::size_t count = 0;
  for (std::size_t p = remainder; p < parts.size(); p += modulus) ++count;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t p = remainder; p < parts.size(); p += modulus) sum += parts[p].pixels[i][c];
      mean.pixels[i][c] = float(sum / double(count));
    }
  return mean;
}

}  // namespace

Reference combineParts(const std::vector<pt::Image>& parts, std::int64_t sppPerPart) {
  Reference reference;
  reference.image = meanOf(parts, 0, 1);
  reference.spp = sppPerPart * std::int64_t(parts.size());
  // The halves are each other's truth with twice the variance of either, which is twice that of the whole: the expected
  // squared difference is 4 times the whole's variance. The weight 1/(r^2 + 0.01) is the whole's.
  const pt::Image even = meanOf(parts, 0, 2), odd = meanOf(parts, 1, 2);
  pt::Image shifted = reference.image;
  for (std::size_t i = 0; i < shifted.pixels.size(); ++i) shifted.pixels[i] += (even.pixels[i] - odd.pixels[i]) * 0.5f;
  reference.noise = measure(shifted, reference.image).relMse;
  return reference;
}

}  // namespace bench
