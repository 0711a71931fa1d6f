#include <memory>

#include "cli/commands.h"
#include "core/error.h"
#include "integrators/guiding_presets.h"
#include "loaders/load_scene.h"
#include "micro/micro.h"
#include "openpgl/openpgl_field.h"
#include "peers/openpgl_bench.h"
#include "synthetic/random.h"

namespace bench {

namespace {

struct Options {
  std::vector<std::filesystem::path> scenes;
  std::int64_t spp = 63;
};

/// A field that was trained in a scene, and places where its paths scatter.
struct TrainedScene {
  std::string name;
  guiding::Field field;
  std::vector<Imath::V3f> places;
};

/// Where paths of a few edges from the camera meet surfaces, their directions spread evenly.
std::vector<Imath::V3f> placesIn(const pt::Scene& scene, int width, int height) {
  constexpr int kPaths = 4096, kEdges = 4;
  Random random(5);
  std::vector<Imath::V3f> places;
  for (int i = 0; i < kPaths; ++i) {
    const pt::Vec2 film(random.next1D() * float(width), random.next1D() * float(height));
    pt::Ray ray = scene.camera().generateRay(film, random.next2D());
    pt::SurfaceInteraction si;
    for (int edge = 0; edge < kEdges && scene.intersect(ray, si); ++edge) {
      places.push_back(si.p);
      ray = scene.spawnRay(si, random.nextDirection());
    }
  }
  return places;
}

TrainedScene trainIn(const std::filesystem::path& file, std::int64_t spp) {
  const pt::SceneDescription description = pt::loadScene(file, {});
  const pt::Scene scene(description);
  pt::RenderSettings settings;
  settings.width = description.film.width;
  settings.height = description.film.height;
  settings.path = description.integrator;
  settings.spp = spp;
  settings.guiding = pt::findGuidingPreset("bound-product")->settings;
  settings.learnFinal = true;
  pt::RenderResult result = pt::render(scene, settings);
  if (!result.field) throw pt::InputError(file.string() + ": there is no material that a guide could help");
  std::vector<Imath::V3f> places = placesIn(scene, settings.width, settings.height);
  if (places.empty()) throw pt::InputError(file.string() + ": the camera sees nothing");
  return {description.name, std::move(*result.field), std::move(places)};
}

int run(const Options& options, std::vector<std::string> arguments) {
  std::vector<TrainedScene> trained;
  for (const std::filesystem::path& scene : options.scenes) trained.push_back(trainIn(scene, options.spp));

  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  return runMicro(int(arguments.size()), argv.data(), [&] {
    for (const TrainedScene& scene : trained) {
      registerLookups(scene.name, scene.field, scene.places);
      registerStorage(scene.name, scene.field);
    }
    if (!pt::hasOpenPgl()) return;
    for (const char* name : {"openpgl", "openpgl-dqt"})
      registerOpenPgl(name, *pt::findGuidingPreset(name)->settings->openPgl);
  });
}

}  // namespace

Command addMicroCommand(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "micro", "Speed of the library's parts; takes Google Benchmark's options too, such as --benchmark_filter=bind");
  command->allow_extras();
  command->add_option("--scene", options->scenes, "Scenes to train fields in (may be repeated), beside synthetic ones")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--spp", options->spp, "Samples per pixel to train with in a scene")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  return {command, [options, command] {
            std::vector<std::string> arguments = command->remaining();
            arguments.insert(arguments.begin(), "guiding-bench micro");
            return run(*options, std::move(arguments));
          }};
}

}  // namespace bench
