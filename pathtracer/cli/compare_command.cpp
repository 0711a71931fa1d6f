#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/options.h"
#include "core/error.h"
#include "core/replace_file.h"
#include "film/image_io.h"
#include "film/metrics.h"

namespace pt {

namespace {

struct CompareOptions {
  std::filesystem::path image, reference, errorPicture;
  float exposure = 0;
};

void checkErrorPicture(const std::filesystem::path& file) {
  if (file.empty()) return;
  if (file.extension() != ".exr" && file.extension() != ".png")
    throw InputError(fmt::format("-o {}: let its name end in .exr or .png", file.string()));
  requireReplaceable(file);
}

void printErrors(const ImageError& error) {
  fmt::print("{:<8} {:>14} {:>24}\n", "", "all pixels", "without the worst 0.1%");
  const auto row = [](const char* name, const ImageError::Measure& m) {
    fmt::print("{:<8} {:>14.6g} {:>24.6g}\n", name, m.all, m.trimmed);
  };
  row("relMSE", error.relMse);
  row("MAPE", error.mape);
  row("SMAPE", error.smape);
  row("MSE", error.mse);
  fmt::print("{:<8} {:>+13.3f}%\n", "bias", 100 * error.bias);
  if (error.nonFinitePixels > 0)
    fmt::print("warning: {} pixels of the picture are not finite and were left out\n", error.nonFinitePixels);
}

void compare(const CompareOptions& options) {
  checkErrorPicture(options.errorPicture);
  requireDistinct({{"-o", options.errorPicture}},
                  {{"the picture", options.image}, {"the reference", options.reference}});
  const Image image = readImage(options.image);
  const Image reference = readImage(options.reference);
  if (image.width != reference.width || image.height != reference.height)
    throw InputError(fmt::format("{} is {}x{}, but {} is {}x{}: only pictures of one size can be compared",
                                 options.image.string(), image.width, image.height, options.reference.string(),
                                 reference.width, reference.height));
  printErrors(compareImages(image, reference));
  if (options.errorPicture.empty()) return;
  const Image errors = errorPicture(image, reference);
  if (options.errorPicture.extension() == ".png")
    writePng(options.errorPicture, errors, options.exposure);
  else
    writeExr(options.errorPicture, errors);
}

}  // namespace

Command addCompareCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compare",
      "Prints how far a picture is from a reference: relMSE, MAPE, SMAPE, MSE, with and without the 0.1% worst pixels");
  auto options = std::make_shared<CompareOptions>();
  command->add_option("picture", options->image, "The picture to judge (EXR, HDR, PNG, ...)")->required();
  command->add_option("reference", options->reference, "What it should be")->required();
  command->add_option("-o,--output", options->errorPicture,
                      "Also writes the relative squared error of each pixel (.exr or .png)");
  command->add_option("--exposure", options->exposure, "Brightens an error picture in PNG by this many stops")
      ->capture_default_str();
  return {command, [options] { compare(*options); }};
}

}  // namespace pt
