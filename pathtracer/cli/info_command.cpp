#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/density_picture.h"
#include "cli/render_job.h"
#include "cli/report.h"
#include "core/error.h"
#include "core/replace_file.h"
#include "film/image_io.h"
#include "integrators/settings_json.h"
#include "loaders/file_search.h"

namespace pt {

namespace {

struct InfoOptions {
  SceneOptions scene;
  bool json = false;
  std::vector<float> at;          ///< point of a field to look at
  std::filesystem::path picture;  ///< of the densities there
};

bool isScene(const std::filesystem::path& file) {
  const std::string ending = lowerCaseEnding(file);
  return ending == ".json" || ending == ".xml" || ending == ".gltf" || ending == ".glb";
}

void printList(const char* title, const std::vector<std::string>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) fmt::print("{:<12} {}\n", i == 0 ? title : "", entries[i]);
}

void printScene(const InfoOptions& options) {
  const SceneDescription description = loadDescription(options.scene);
  const Scene scene(description);
  if (options.json) {
    fmt::print("{}\n", toJson(scene, description).dump(2));
    return;
  }
  const SceneCounts& counts = scene.counts();
  const FilmDescription& film = description.film;
  // Where the scene's file has them, not where they were moved to for the sake of precision.
  const Vec3 lower(scene.origin() + Imath::V3d(scene.bounds().min)),
      upper(scene.origin() + Imath::V3d(scene.bounds().max));
  fmt::print("{:<12} {}\n", "scene", description.name);
  fmt::print("{:<12} {}x{}, {} samples per pixel\n", "picture", film.width, film.height, description.spp);
  fmt::print("{:<12} max depth {}, roulette after {}\n", "paths", description.integrator.maxDepth,
             description.integrator.rrDepth);
  fmt::print("{:<12} {} triangles, {} other primitives, {} instances\n", "geometry", counts.triangles,
             counts.primitives - counts.triangles, counts.instances);
  fmt::print("{:<12} ({}, {}, {}) to ({}, {}, {})\n", "bounds", lower.x, lower.y, lower.z, upper.x, upper.y, upper.z);
  fmt::print("{:<12} {} lights, {} materials\n", "content", counts.lights, counts.materials);
  fmt::print("{:<12} {:.1f} MB\n", "memory", double(counts.memoryBytes) / 1e6);
  printList("present", scene.features().present);
  printList("left out", scene.features().leftOut);
  printList("skipped", description.skipped);
  printList("notes", description.notes);
}

void checkPoint(const InfoOptions& options) {
  if (options.at.empty() && options.picture.empty()) return;
  if (isScene(options.scene.file))
    throw InputError(fmt::format("{}: is a scene; --at and -o look into a trained field", options.scene.file.string()));
  if (options.at.empty()) throw InputError("-o draws the densities at a point: give it as --at x,y,z");
  if (options.picture.empty()) throw InputError("--at draws the densities at that point: name the picture with -o");
  if (options.picture.extension() != ".png")
    throw InputError(fmt::format("-o {}: let its name end in .png", options.picture.string()));
  requireReplaceable(options.picture);
}

/// The density learned at a point and the one sampled there, side by side.
void drawDensities(const guiding::Field& field, const InfoOptions& options) {
  const Vec3 position(options.at[0], options.at[1], options.at[2]), &lower = field.bounds().min,
                                                                    &upper = field.bounds().max;
  if (!field.bounds().intersects(position))
    fmt::print(
        stderr,
        "warning: ({}, {}, {}) lies outside the field's bounds, ({}, {}, {}) to ({}, {}, {}); the nearest leaf is "
        "shown\n",
        position.x, position.y, position.z, lower.x, lower.y, lower.z, upper.x, upper.y, upper.z);
  const guiding::GuidingDistribution guide = field.bind(position);
  writePng(options.picture, densityPicture([&](const Vec3& wi) { return field.learnedPdf(position, wi); },
                                           [&](const Vec3& wi) { return guide ? guide.pdf(wi) : 0.0f; }));
  if (guide)
    fmt::print("{:<12} learned (left) and sampled (right), {:.0f}% of the samples from the BSDF\n", "densities",
               100 * guide.bsdfSamplingFraction());
  else
    fmt::print("{:<12} learned (left); no guide is offered here\n", "densities");
}

void printField(const InfoOptions& options) {
  const guiding::Field field = loadField(options.scene.file);
  if (!options.picture.empty()) return drawDensities(field, options);
  const guiding::FieldStats stats = field.stats();
  if (options.json) {
    nlohmann::ordered_json json = toJson(stats);
    json["settings"] = toJson(field.settings());
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{:<12} {} in {} iterations ({} dropped, {} outside the bounds)\n", "samples", stats.samples,
             stats.iterations, stats.droppedSamples, stats.outsideSamples);
  fmt::print("{:<12} {} ({} guided), depth up to {}{}\n", "leaves", stats.spatialLeaves, stats.guidedLeaves,
             stats.maxSpatialDepth, stats.memoryCapReached ? "; held back by the memory cap" : "");
  std::string histogram;
  for (const std::size_t leaves : stats.fractionHistogram) histogram += fmt::format(" {}", leaves);
  fmt::print("{:<12}{} leaves by tenths of the bsdfSamplingFraction; {} rest\n", "fractions", histogram,
             stats.restingLeaves);
  fmt::print("{:<12} {} nodes, depth up to {}, {:.1f} in the mean\n", "quadtrees", stats.quadtreeNodes,
             stats.maxQuadtreeDepth, stats.meanQuadtreeDepth);
  fmt::print("{:<12} {:.1f}% of the sphere emptied in the mean\n", "compensation", 100 * stats.compensatedArea);
  fmt::print("{:<12} {:.1f} MB\n", "memory", double(stats.memoryBytes) / 1e6);
  fmt::print("{:<12} {}\n", "settings", toJson(field.settings()).dump());
}

}  // namespace

Command addInfoCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Describes a scene or a trained field");
  auto options = std::make_shared<InfoOptions>();
  addOptions(*command, options->scene);
  command->get_option("scene")->description("Scene file (.json, .xml, .gltf, .glb) or trained field");
  command->add_flag("--json", options->json, "Prints JSON, for scripts");
  command->add_option("--at", options->at, "A point x,y,z of a field: draws the densities there")
      ->delimiter(',')
      ->expected(3);
  command->add_option("-o,--output", options->picture,
                      "PNG of the learned density and of the one that is sampled, unrolled with +y up");
  return {command, [options] {
            checkPoint(*options);
            isScene(options->scene.file) ? printScene(*options) : printField(*options);
          }};
}

}  // namespace pt
