#include "report/report_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "film/image_io.h"
#include "film/metrics.h"
#include "reference/reference.h"
#include "run/keys.h"

namespace bench {

namespace {

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string dataUrl(const std::filesystem::path& png) {
  std::ifstream stream(png, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  return "data:image/png;base64," + base64(bytes);
}

/// Stops that bring the 90th percentile of the picture's luminance to 0.5.
float exposureFor(const pt::Image& image) {
  std::vector<float> luminances;
  for (const pt::Spectrum& pixel : image.pixels) luminances.push_back(pt::luminance(pixel));
  const auto at = luminances.begin() + std::ptrdiff_t(luminances.size() * 9 / 10);
  std::nth_element(luminances.begin(), at, luminances.end());
  return *at > 0 ? std::log2(0.5f / *at) : 0.0f;
}

/// From black over blue, red and yellow to white for errors from 0.0001 to 1 and more.
pt::Spectrum errorColour(float error) {
  static const pt::Spectrum kStops[] = {{0, 0, 0}, {0.02f, 0.04f, 0.4f}, {0.7f, 0.02f, 0.05f}, {1, 0.7f, 0}, {1, 1, 1}};
  const float position = std::clamp(std::log10(std::max(error, 1e-4f)) + 4, 0.0f, 4.0f);
  const int i = std::min(3, int(position));
  return kStops[i] + (kStops[i + 1] - kStops[i]) * (position - float(i));
}

pt::Image errorMap(const pt::Image& image, const pt::Image& reference) {
  pt::Image map = pt::errorPicture(image, reference);
  for (pt::Spectrum& pixel : map.pixels) pixel = errorColour(pt::average(pixel));
  return map;
}

Json entry(const std::string& label, const std::filesystem::path& png, const pt::Image& image, bool isError) {
  return {{"label", label},
          {"width", image.width},
          {"height", image.height},
          {"isError", isError},
          {"source", dataUrl(png)}};
}

}  // namespace

Json picturesOf(const ScenePlan& scene, const std::vector<std::string>& names, const RunFolder& folder) {
  Json pictures = Json::array(), maps = Json::array();
  const ReferenceEstimator& main = scene.reference.main;
  const ReferenceStore store(folder.references);
  const std::string key = referenceKey(scene, main, hashScene(scene));
  for (int i = 0; i < main.parts; ++i)
    if (!store.hasPart(key, i)) return pictures;

  const pt::Image reference = combineParts(store.loadParts(key, main.parts), main.sppPerPart).image;
  const float exposure = exposureFor(reference);
  const auto add = [&](Json& list, const std::string& label, const std::string& file, const pt::Image& image,
                       float stops, bool isError) {
    const std::filesystem::path png = folder.root / "pictures" / (scene.name + "." + file + ".png");
    std::filesystem::create_directories(png.parent_path());
    pt::writePng(png, image, stops);
    list.push_back(entry(label, png, image, isError));
  };
  for (const std::string& name : names) {
    if (!std::filesystem::exists(folder.picture(scene.name, name))) continue;
    const pt::Image image = pt::readImage(folder.picture(scene.name, name));
    add(pictures, name, name, image, exposure, false);
    add(maps, name + " (error)", name + ".error", errorMap(image, reference), 0, true);
  }
  add(pictures, "reference", "reference", reference, exposure, false);
  for (const Json& map : maps) pictures.push_back(map);
  return pictures;
}

}  // namespace bench
