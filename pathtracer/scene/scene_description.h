#pragma once

#include <guiding/environment_layout.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/types.h"

/// What a loader yields and a Scene is built from: plain data, no behaviour.
namespace pt {

struct Image;

inline constexpr int kNone = -1;

/// Where in the input a thing was described, for messages: "file.xml:12" or "scene.json#/materials/3".
using SourceLocation = std::string;

// ---------------------------------------------------------------- textures and parameters

/// A constant, or with `texture` (index into SceneDescription::textures) that texture times `value`.
struct SpectrumParameter {
  Spectrum value{0.5f};
  int texture = kNone;

  SpectrumParameter() = default;
  SpectrumParameter(const Spectrum& v, int t = kNone) : value(v), texture(t) {}
  SpectrumParameter(float v) : value(v) {}
};
struct FloatParameter {
  float value = 0;
  int texture = kNone;

  FloatParameter() = default;
  FloatParameter(float v, int t = kNone) : value(v), texture(t) {}
};

/// How the numbers of a picture of integers encode light; pictures of floats are linear whatever is said.
enum class TextureEncoding { Srgb, Linear };
/// What of a picture is read. Color: all three channels, or luminance where one number is asked for.
enum class TextureChannel { Color, Red, Green, Blue, Alpha };
/// Bilinear reads the finest level: as sharp as the picture's samples can show, they do the averaging. Trilinear reads
/// a mip map at the width of a pixel seen by the camera.
enum class TextureFilter { Nearest, Bilinear, Trilinear };
/// What lies outside of [0, 1].
enum class TextureWrap { Repeat, Mirror, Clamp, Black };

struct BitmapTexture {
  std::filesystem::path file;
  std::shared_ptr<const std::string> bytes =
      nullptr;  ///< of the picture, where it lies within another file; `file` is its name
  TextureEncoding encoding = TextureEncoding::Srgb;
  TextureChannel channel = TextureChannel::Color;
  TextureFilter filter = TextureFilter::Bilinear;
  TextureWrap wrapU = TextureWrap::Repeat, wrapV = TextureWrap::Repeat;
};
/// Squares of half a unit; color0 where both coordinates lie in the same half of theirs.
struct CheckerboardTexture {
  Spectrum color0{0.4f}, color1{0.2f};
};
struct TextureDescription {
  std::variant<BitmapTexture, CheckerboardTexture> kind;
  Matrix3 uvTransform;  ///< row vectors: what is read at (u, v, 1) * uvTransform; affine
  SourceLocation source;
};

// ---------------------------------------------------------------- materials

enum class MicrofacetDistribution { Beckmann, Ggx };

struct Roughness {
  FloatParameter alpha{0.1f};  ///< root-mean-square slope of the microfacets; > 0
  MicrofacetDistribution distribution = MicrofacetDistribution::Beckmann;
  bool sampleVisible = true;
  std::optional<FloatParameter> alphaV = {};  ///< along v where it differs: `alpha` is then that along u
};

struct DiffuseMaterial {
  SpectrumParameter reflectance{0.5f};
};
/// Oren & Nayar's model of matt facets.
struct RoughDiffuseMaterial {
  SpectrumParameter reflectance{0.5f};
  FloatParameter alpha{0.2f};  ///< root-mean-square slope, as of microfacets; the model's sigma is alpha / sqrt(2)
  bool fastApproximation = false;
};
/// Smooth without, rough with `roughness`. A perfect mirror has eta 0, k 1.
struct ConductorMaterial {
  Spectrum eta{0.0f}, k{1.0f};  ///< relative to the exterior
  SpectrumParameter specularReflectance{1.0f};
  std::optional<Roughness> roughness;
};
struct DielectricMaterial {
  float intIor = 1.5046f, extIor = 1.000277f;
  SpectrumParameter specularReflectance{1.0f}, specularTransmittance{1.0f};
  std::optional<Roughness> roughness;
};
struct ThinDielectricMaterial {
  float intIor = 1.5046f, extIor = 1.000277f;
  SpectrumParameter specularReflectance{1.0f}, specularTransmittance{1.0f};
};
/// What becomes of light inside a rough plastic that meets the boundary from there and is masked by its facets.
enum class RoughBoundary {
  KeepsMasked,  ///< all that does not leave returns to the base (Mitsuba 0.6)
  LosesMasked   ///< only what facets reflect returns; Mitsuba 2 and 3, with their sum over 64 angles
};
struct PlasticMaterial {
  float intIor = 1.49f, extIor = 1.000277f;
  SpectrumParameter diffuseReflectance{0.5f}, specularReflectance{1.0f};
  bool nonlinear = false;  ///< account for colour shifts of light that bounces inside
  std::optional<Roughness> roughness;
  RoughBoundary roughBoundary = RoughBoundary::KeepsMasked;
};
/// Indices into SceneDescription::materials; `back` may equal `front`.
struct TwoSidedMaterial {
  int front = kNone, back = kNone;
};
/// Lets everything pass straight on.
struct NullMaterial {};
/// A share of the light, by area, meets the material and the rest passes straight on.
struct MaskMaterial {
  int material = kNone;
  FloatParameter opacity{0.5f};
  std::optional<float> cutoff = std::nullopt;  ///< opacities below it count as 0, the others as 1
};

/// The first material's share is 1 - weight.
struct BlendMaterial {
  int first = kNone, second = kNone;
  FloatParameter weight{0.5f};
};
/// Turns the shading normal as if the surface were displaced along it by `scale` times the texture.
struct BumpMaterial {
  int material = kNone;
  int texture = kNone;
  float scale = 1;
};
/// Shading normals read from a texture: 2 c - 1 along tangent, bitangent and normal.
struct NormalMapMaterial {
  int material = kNone;
  int texture = kNone;
  float scale = 1;             ///< of the first two
  bool mirrorsWithUv = false;  ///< the bitangent follows mirrored texture coordinates (glTF), else it is n x tangent
};
/// Metal or plastic or glass or something between, by few numbers in [0, 1], as glTF 2.0's metallic-roughness material
/// with its extensions for transmission, sheen, clearcoat, specular and index of refraction; and Mitsuba's anisotropy.
struct PrincipledMaterial {
  SpectrumParameter baseColor{0.5f};
  FloatParameter metallic{0.0f};
  FloatParameter roughness{0.5f};     ///< square root of the microfacets' alpha
  float anisotropy = 0;               ///< highlights stretch along u; alpha along u and v are in ratio 1 / (1 - .9 a)
  float ior = 1.5f;                   ///< of the inside over the outside
  SpectrumParameter specular{1.0f};   ///< factor on the reflection of what is not metal
  FloatParameter transmission{0.0f};  ///< share of what is not metal that lets light through instead of a diffuse base
  bool thin = false;                  ///< light passes unbent: the surface is both sides of a sheet
  SpectrumParameter sheen{0.0f};      ///< colour of fibres seen at grazing angles
  FloatParameter clearcoat{0.0f};
  FloatParameter clearcoatRoughness{0.0f};
};

struct MaterialDescription {
  std::string name;
  std::variant<DiffuseMaterial, RoughDiffuseMaterial, ConductorMaterial, DielectricMaterial, ThinDielectricMaterial,
               PlasticMaterial, TwoSidedMaterial, NullMaterial, MaskMaterial, BlendMaterial, BumpMaterial,
               NormalMapMaterial, PrincipledMaterial>
      kind;
  SourceLocation source;
  /// Of the medium behind a surface that lets light through, per unit of length and channel: exp(-absorption * way) of
  /// the light is left. 0: clear, or as the materials inside have it.
  Spectrum absorption{0.0f};
};

// ---------------------------------------------------------------- shapes

/// Triangles with optional per-vertex normals and texture coordinates (empty when absent, else one per position).
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;  ///< shared by every shape that shows it
  bool faceNormals = false;                  ///< ignore the vertex normals
};
struct SphereShape {
  Vec3 center{0, 0, 0};
  float radius = 1;
};
/// The square [-1,1]^2 of the xy plane, normal +z.
struct RectangleShape {};
/// The unit disk of the xy plane, normal +z.
struct DiskShape {};
/// [-1,1]^3, normals outwards.
struct CubeShape {};
/// Without caps; normals outwards.
struct CylinderShape {
  Vec3 p0{0, 0, 0}, p1{0, 0, 1};  ///< ends of the axis
  float radius = 1;
};
/// A copy of SceneDescription::groups[group].
struct InstanceShape {
  int group = kNone;
};

struct ShapeDescription {
  std::string name;
  std::variant<MeshShape, SphereShape, RectangleShape, DiskShape, CubeShape, CylinderShape, InstanceShape> kind;
  Matrix4 toWorld;  ///< row vectors: world = object * toWorld
  bool flipNormals = false;
  int material = kNone;                       ///< none: reflects nothing
  std::optional<SpectrumParameter> emission;  ///< radiance; one-sided, on the side of the shading normal
  SourceLocation source;
};

/// Shapes that are instanced together; in a space of their own. They cannot emit.
struct GroupDescription {
  std::string name;
  std::vector<ShapeDescription> shapes;
};

// ---------------------------------------------------------------- lights that are not shapes

struct PointLight {
  Vec3 position{0, 0, 0};
  Spectrum intensity{1.0f};  ///< power per unit solid angle
};
enum class SpotFalloff {
  Angle,         ///< linear in the angle, as Mitsuba's
  CosineSquared  ///< square of a ramp over the cosine, as glTF's
};
struct SpotLight {
  Vec3 position{0, 0, 0};
  Vec3 direction{0, 0, 1};   ///< of the beam's axis; any length but 0
  Spectrum intensity{1.0f};  ///< power per unit solid angle, within the beam
  float cutoffDegrees = 20;  ///< half angle of the cone that gets any light, at most 180
  float beamDegrees = 15;    ///< half angle of the cone that gets all of it, at most the cutoff
  SpotFalloff falloff = SpotFalloff::Angle;
};
/// Parallel light from infinitely far away.
struct DirectionalLight {
  Vec3 direction{0, 0, 1};    ///< in which the light travels; any length but 0
  Spectrum irradiance{1.0f};  ///< of a surface that faces it
};
struct ConstantEnvironment {
  Spectrum radiance{1.0f};
};
/// A picture of the light from all directions.
struct EnvironmentMap {
  std::shared_ptr<const Image> image;  ///< radiance; finite, not negative
  guiding::EnvironmentMapping mapping = guiding::EnvironmentMapping::LatLong;
  Matrix4 toWorld;  ///< a rotation, perhaps mirrored or scaled
  float scale = 1;  ///< of the radiance
};
/// How the density by which light sampling goes is sharpened where it is weighted against BSDF sampling.
enum class EnvironmentForm {
  Plain,         ///< not at all
  Mean,          ///< the mean is subtracted: guiding::EnvironmentCompensation::SubtractMean
  WaterFilling,  ///< guiding::EnvironmentCompensation::WaterFilling
  Normal,  ///< an amount by the normal is subtracted, the rest multiplied by the cosine: guiding::EnvironmentByNormal
};
struct EnvironmentSampling {
  EnvironmentForm form = EnvironmentForm::Normal;
  /// Share of light samples that is assumed, in (0, 1); 0: what the path tracer does, one sample of one light, chosen
  /// by power, beside one of the BSDF.
  float lightShare = 0;
};

struct LightDescription {
  std::variant<PointLight, SpotLight, DirectionalLight, ConstantEnvironment, EnvironmentMap> kind;
  SourceLocation source;
};

// ---------------------------------------------------------------- camera, film, integrator

enum class FovAxis { X, Y, Smaller, Larger, Diagonal };

enum class Projection { Perspective, Orthographic };

/// Looks down its own +z with +x to the image's left and +y up, as Mitsuba's. Lengths are in the camera's own space.
struct CameraDescription {
  Matrix4 toWorld;
  Projection projection = Projection::Perspective;  ///< orthographic: the picture's width is x from -1 to 1
  float fovDegrees = 45;                            ///< of a perspective
  FovAxis fovAxis = FovAxis::X;
  float apertureRadius = 0;  ///< of the thin lens of a perspective; 0: a pinhole
  float focusDistance = 1;   ///< depth of the plane that a lens shows sharply
  float nearClip = 1e-4f;
  float farClip = std::numeric_limits<float>::infinity();
};

enum class ReconstructionFilter { Box, Tent, Gaussian };

/// Largest width or height of a picture, and the most pixels of one.
inline constexpr int kMaxFilmSize = 1 << 17;
inline constexpr std::int64_t kMaxFilmPixels = std::int64_t(1) << 28;

struct FilmDescription {
  int width = 768, height = 576;
  ReconstructionFilter filter = ReconstructionFilter::Box;
};

enum class SamplerKind { Independent, Sobol };

struct IntegratorDescription {
  int maxDepth = -1;  ///< path length in edges, 1 is emission only; -1: unbounded
  int rrDepth = 5;    ///< edges after which classic Russian roulette may end the path
  bool strictNormals = false;
  bool hideEmitters = false;
};

struct SceneDescription {
  std::string name;  ///< shown to people
  std::filesystem::path file;
  std::optional<CameraDescription> camera;
  FilmDescription film;
  SamplerKind sampler = SamplerKind::Sobol;
  int spp = 64;
  IntegratorDescription integrator;
  std::vector<TextureDescription> textures;
  std::size_t textureMemoryBytes = std::size_t(1) << 30;  ///< what does not fit is read through a cache of tiles
  std::vector<MaterialDescription> materials;
  std::vector<ShapeDescription> shapes;
  std::vector<GroupDescription> groups;
  std::vector<LightDescription> lights;
  EnvironmentSampling environmentSampling;
  std::vector<std::string> skipped;  ///< what --skip-unsupported left out, with its place
  std::vector<std::string> notes;    ///< choices the loader made that its user should know
};

}  // namespace pt
