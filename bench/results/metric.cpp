#include "results/metric.h"

#include "film/metrics.h"

namespace bench {

PictureError measure(const pt::Image& image, const pt::Image& reference) {
  const pt::ImageError e = pt::compareImages(image, reference);
  return {e.relMse.all, e.relMse.trimmed, e.mape.all, e.smape.all, e.mse.all, e.bias};
}

}  // namespace bench
