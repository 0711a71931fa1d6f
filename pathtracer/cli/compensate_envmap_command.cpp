#include <fmt/format.h>
#include <guiding/environment.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/options.h"
#include "core/error.h"
#include "core/replace_file.h"
#include "film/image_io.h"
#include "lights/predict_environment.h"
#include "loaders/environment_file.h"

namespace pt {

namespace {

using Json = nlohmann::ordered_json;

struct CompensateOptions {
  std::filesystem::path map, output, report, png;
  std::string form = "mean", mapping = "latLong";
  float share = 0.5f;
};

guiding::EnvironmentSettings settingsOf(const CompensateOptions& options) {
  if (options.form == "half") return {guiding::EnvironmentCompensation::SubtractMean, (1 + options.share) / 2};
  return {options.form == "mean" ? guiding::EnvironmentCompensation::SubtractMean
                                 : guiding::EnvironmentCompensation::WaterFilling,
          options.share};
}

guiding::EnvironmentMapping mappingOf(const CompensateOptions& options) {
  if (options.mapping == "octahedral") return guiding::EnvironmentMapping::Octahedral;
  return options.mapping == "latLong" ? guiding::EnvironmentMapping::LatLong
                                      : guiding::EnvironmentMapping::LatLongToPoles;
}

void fillOutputNames(CompensateOptions& options) {
  if (options.output.extension() != ".exr")
    throw InputError(fmt::format("-o {}: let the map's name end in .exr", options.output.string()));
  const auto beside = [&](const char* ending) {
    return std::filesystem::path(options.output).replace_extension(ending);
  };
  if (options.report.empty()) options.report = beside(".report.json");
  if (options.png.empty()) options.png = beside(".png");
  requireDistinct({{"-o", options.output}, {"--report", options.report}, {"--png", options.png}},
                  {{"the map", options.map}});
  for (const auto& file : {options.output, options.report, options.png}) requireReplaceable(file);
}

Image greyImage(const guiding::EnvironmentLayout& layout, const std::vector<float>& values) {
  Image image(layout.width(), layout.height());
  for (std::size_t i = 0; i < values.size(); ++i) image.pixels[i] = Spectrum(values[i]);
  return image;
}

/// Both densities one beside the other, each scaled to the same integral; the cube root shows sun and sky at once.
Image sideBySide(const guiding::EnvironmentLayout& layout, const std::vector<float>& left,
                 const std::vector<float>& right) {
  const auto scaleOf = [&](const std::vector<float>& values) {
    double mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      mean += values[i] * layout.texelShare(int(i / std::size_t(layout.width())));
    return mean > 0 ? 0.02 / mean : 0;
  };
  const double scales[2] = {scaleOf(left), scaleOf(right)};
  constexpr int kGap = 4;
  Image image(2 * layout.width() + kGap, layout.height());
  for (Spectrum& pixel : image.pixels) pixel = Spectrum(1.0f);
  for (int y = 0; y < layout.height(); ++y)
    for (int x = 0; x < 2 * layout.width(); ++x) {
      const bool isRight = x >= layout.width();
      const std::size_t i = std::size_t(y * layout.width() + x % layout.width());
      image.at(x + (isRight ? kGap : 0), y) = Spectrum(float(std::cbrt((isRight ? right : left)[i] * scales[isRight])));
    }
  return image;
}

void compensateMap(CompensateOptions options) {
  fillOutputNames(options);
  std::vector<std::string> notes;
  const std::shared_ptr<const Image> map = readEnvironment(options.map, "the map", notes);
  for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);

  const guiding::EnvironmentLayout layout(mappingOf(options), map->width, map->height);
  if (layout.mapping() == guiding::EnvironmentMapping::Octahedral && map->width != map->height)
    throw InputError(fmt::format("{}: an octahedral map is square, this one has {}x{} texels; leave --mapping out",
                                 options.map.string(), map->width, map->height));
  std::vector<float> luminances, sharpened(map->pixels.size());
  for (const Spectrum& c : map->pixels) luminances.push_back(luminance(c));
  const auto sharpening = guiding::sharpenEnvironment({layout, luminances}, settingsOf(options), sharpened);
  if (!sharpening) throw InputError(fmt::format("{}: {}", options.map.string(), sharpening.error().text));
  if (sharpening.value().empty)
    throw InputError(
        fmt::format("{}: the map is black or nearly constant, and nothing would be left to sample; let the renderer "
                    "sample its materials alone",
                    options.map.string()));

  const double before = predictVariance({layout, luminances}, luminances);
  const double after = predictVariance({layout, luminances}, sharpened);
  writeExr(options.output, greyImage(layout, sharpened));
  writePng(options.png, sideBySide(layout, luminances, sharpened));
  const Json report = {{"map", options.map.string()},
                       {"width", layout.width()},
                       {"height", layout.height()},
                       {"mapping", options.mapping},
                       {"form", options.form},
                       {"lightShare", options.share},
                       {"meanLuminance", sharpening.value().mean},
                       {"removedMass", sharpening.value().removedMass},
                       {"predictedVariance", {{"plain", before}, {"compensated", after}}},
                       {"predictedGain", before / after}};
  replaceFile(options.report, report.dump(2) + "\n");
  fmt::print(
      "{:.1f}% of the light lies where nothing is sampled any more; on diffuse surfaces in the open {:.2f} times less "
      "variance\nmap     {}\npicture {}\nreport  {}\n",
      100 * sharpening.value().removedMass, before / after, options.output.string(), options.png.string(),
      options.report.string());
}

}  // namespace

Command addCompensateEnvmapCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compensate-envmap",
      "Writes the map by which any renderer should draw its light samples from an HDR map, where it weights them "
      "against "
      "samples of the material (MIS). Only the density comes from it: the light itself stays that of the HDR map.");
  auto options = std::make_shared<CompensateOptions>();
  command->add_option("map", options->map, "The HDR map (EXR, HDR, ...)")->required();
  command->add_option("-o,--output", options->output, "The map to sample by, *.exr")->required();
  command->add_option("--png", options->png, "Both densities side by side (default: beside the map, *.png)");
  command->add_option("--report", options->report, "Mass removed, predicted gain (default: *.report.json)");
  command
      ->add_option("--form", options->form,
                   "mean: 2 (1 - share) times the mean is subtracted; waterfill: the best for a material that scatters "
                   "evenly; half: half as much as mean, for renderers that multiply the map with the cosine")
      ->check(CLI::IsMember({"mean", "waterfill", "half"}))
      ->capture_default_str();
  command->add_option("--share", options->share, "Light samples by all samples, those of the material counted in")
      ->check(CLI::Range(0.01, 0.99))
      ->capture_default_str();
  command->add_option("--mapping", options->mapping, "latLong, latLongToPoles (Mitsuba 3) or octahedral (pbrt-v4)")
      ->check(CLI::IsMember({"latLong", "latLongToPoles", "octahedral"}))
      ->capture_default_str();
  return {command, [options] { compensateMap(*options); }};
}

}  // namespace pt
