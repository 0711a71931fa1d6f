// Textures and the materials that were made for them, in both formats.
#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

struct Loaded {
  SceneDescription scene;
  const MaterialDescription& material() const { return scene.materials.at(std::size_t(scene.shapes.at(0).material)); }
  template <class Kind>
  const Kind& as() const {
    return materialAs<Kind>(scene, scene.shapes.at(0).material);
  }
  const TextureDescription& texture(int index) const { return scene.textures.at(std::size_t(index)); }
  const BitmapTexture& bitmap(int index) const { return std::get<BitmapTexture>(texture(index).kind); }
};

struct Fixture {
  SceneFolder folder;
  Fixture() { folder.write("wood.png", "looked at when the scene is built"); }

  Loaded mitsuba(const std::string& bsdf, const std::string& version = "3.0.0") const {
    return {folder.load("a.xml", mitsubaScene("<shape type=\"sphere\">" + bsdf + "</shape>", version))};
  }
  std::string mitsubaError(const std::string& bsdf, const std::string& version = "3.0.0") const {
    return folder.errorOf("a.xml", mitsubaScene("<shape type=\"sphere\">" + bsdf + "</shape>", version));
  }
  static std::string jsonScene(const std::string& material, const std::string& textures) {
    return "{\"textures\": {" + textures + "}, \"shapes\": [{\"type\": \"sphere\", \"material\": " + material + "}]}";
  }
  Loaded json(const std::string& material, const std::string& textures = "") const {
    return {folder.load("a.json", jsonScene(material, textures))};
  }
  std::string jsonError(const std::string& material, const std::string& textures = "") const {
    return folder.errorOf("a.json", jsonScene(material, textures));
  }
};

const std::string kWood = R"(<string name="filename" value="wood.png"/>)";

std::string diffuse(const std::string& texture) {
  return "<bsdf type=\"diffuse\">" + texture + "</bsdf>";
}
std::string wood(const std::string& properties) {
  return diffuse("<texture name=\"reflectance\" type=\"bitmap\">" + kWood + properties + "</texture>");
}

bool maps(const Matrix3& m, const Vec2& from, const Vec2& to) {
  Vec2 result;
  m.multVecMatrix(from, result);
  return (result - to).length() < 1e-5f;
}

}  // namespace

TEST_CASE_METHOD(Fixture, "Mitsuba: a bitmap, with the defaults of both generations") {
  const auto three = mitsuba(wood("")), old = mitsuba(wood(""), "0.5.0");
  const SpectrumParameter& reflectance = three.as<DiffuseMaterial>().reflectance;
  CHECK(reflectance.value == Spectrum(1.0f));
  REQUIRE(reflectance.texture == 0);
  CHECK(three.bitmap(0).file == folder.path() / "wood.png");
  CHECK(three.bitmap(0).filter == TextureFilter::Bilinear);
  CHECK(three.bitmap(0).encoding == TextureEncoding::Srgb);
  CHECK(three.bitmap(0).wrapU == TextureWrap::Repeat);
  CHECK(old.bitmap(0).filter == TextureFilter::Trilinear);
}

TEST_CASE_METHOD(Fixture, "Mitsuba: a bitmap's properties") {
  const auto three = mitsuba(wood(R"(<boolean name="raw" value="true"/><string name="filter_type" value="nearest"/>
    <string name="wrap_mode" value="mirror"/><transform name="to_uv"><scale x="2" y="3"/><translate x="0.5"/></transform>)"));
  CHECK(three.bitmap(0).encoding == TextureEncoding::Linear);
  CHECK(three.bitmap(0).filter == TextureFilter::Nearest);
  CHECK(three.bitmap(0).wrapV == TextureWrap::Mirror);
  CHECK(maps(three.texture(0).uvTransform, {1, 1}, {2.5f, 3}));

  const auto old = mitsuba(wood(R"(<float name="gamma" value="1"/><string name="filterType" value="trilinear"/>
    <string name="wrapModeU" value="clamp"/><string name="channel" value="a"/>
    <float name="uscale" value="2"/><float name="voffset" value="0.25"/>)"),
                           "0.6.0");
  CHECK(old.bitmap(0).encoding == TextureEncoding::Linear);
  CHECK(old.bitmap(0).filter == TextureFilter::Trilinear);
  CHECK(old.bitmap(0).channel == TextureChannel::Alpha);
  CHECK(old.bitmap(0).wrapU == TextureWrap::Clamp);
  CHECK(old.bitmap(0).wrapV == TextureWrap::Repeat);
  CHECK(maps(old.texture(0).uvTransform, {1, 1}, {2, 1.25f}));
  CHECK_THAT(mitsubaError(wood(R"(<float name="gamma" value="1.4"/>)"), "0.6.0"), Catch::Contains("gamma 1.4"));
  CHECK_THAT(mitsubaError(wood(R"(<string name="filter_type" value="bicubic"/>)")), Catch::Contains("'bicubic'"));
}

TEST_CASE_METHOD(Fixture, "Mitsuba: checkerboards, scaled textures, shared textures") {
  const auto board = mitsuba(diffuse(R"(<texture name="reflectance" type="checkerboard">
    <rgb name="color0" value="0.8"/><transform name="to_uv"><scale x="20" y="80"/></transform></texture>)"));
  CHECK(std::get<CheckerboardTexture>(board.texture(0).kind).color0 == Spectrum(0.8f));
  CHECK(std::get<CheckerboardTexture>(board.texture(0).kind).color1 == Spectrum(0.2f));
  CHECK(maps(board.texture(0).uvTransform, {1, 1}, {20, 80}));

  const auto scaled =
      mitsuba(diffuse("<texture name=\"reflectance\" type=\"scale\"><float name=\"scale\" value=\"0.3\"/>"
                      "<texture type=\"bitmap\">" +
                      kWood + "</texture></texture>"),
              "0.6.0");
  CHECK(scaled.as<DiffuseMaterial>().reflectance.value == Spectrum(0.3f));
  CHECK(scaled.scene.textures.size() == 1);

  const auto shared =
      mitsuba("<bsdf type=\"roughplastic\"><texture name=\"diffuse_reflectance\" type=\"bitmap\" id=\"w\">" + kWood +
              "</texture><ref name=\"alpha\" id=\"w\"/></bsdf>");
  CHECK(shared.scene.textures.size() == 1);
  CHECK(shared.as<PlasticMaterial>().roughness->alpha.texture == 0);
  CHECK_THAT(mitsubaError(diffuse(R"(<texture name="reflectance" type="scale" id="s"><ref id="s"/></texture>)")),
             Catch::Contains("contains itself"));
  CHECK_THAT(
      mitsubaError(diffuse(R"(<rgb name="reflectance" value="1"/><texture name="reflectance" type="checkerboard"/>)")),
      Catch::Contains("given twice"));
}

TEST_CASE_METHOD(Fixture, "Mitsuba: mask, rough diffuse, null, textured lamps") {
  const auto masked = mitsuba("<bsdf type=\"mask\"><texture name=\"opacity\" type=\"bitmap\">" + kWood +
                              "</texture><bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf></bsdf>");
  const auto& mask = masked.as<MaskMaterial>();
  CHECK(mask.opacity.value == Approx(1));
  CHECK(mask.opacity.texture == 0);
  materialAs<TwoSidedMaterial>(masked.scene, mask.material);
  CHECK(mitsuba(R"(<bsdf type="mask"><bsdf type="plastic"/></bsdf>)").as<MaskMaterial>().opacity.value == 0.5f);
  CHECK(mitsuba(R"(<bsdf type="mask"><rgb name="opacity" value="0.2"/><bsdf type="plastic"/></bsdf>)")
            .as<MaskMaterial>()
            .opacity.value == Approx(0.2f));
  CHECK_THAT(mitsubaError(R"(<bsdf type="mask"/>)"), Catch::Contains("needs one bsdf inside, not 0"));

  const auto matt = mitsuba(R"(<bsdf type="roughdiffuse"><float name="alpha" value="0.3"/>
    <boolean name="useFastApprox" value="true"/></bsdf>)",
                            "0.6.0");
  CHECK(matt.as<RoughDiffuseMaterial>().alpha.value == 0.3f);
  CHECK(matt.as<RoughDiffuseMaterial>().fastApproximation);
  mitsuba(R"(<bsdf type="null"/>)").as<NullMaterial>();

  const auto lamp =
      mitsuba("<emitter type=\"area\"><texture name=\"radiance\" type=\"bitmap\">" + kWood + "</texture></emitter>");
  REQUIRE(lamp.scene.shapes[0].emission);
  CHECK(lamp.scene.shapes[0].emission->texture == 0);
}

TEST_CASE_METHOD(Fixture, "scene.json: textures by name and in place, sRGB for colours and linear for numbers") {
  const auto loaded = json(R"({"type": "plastic", "diffuseReflectance": {"texture": "wood", "scale": 0.5},
    "alpha": {"texture": "wood", "scale": 0.2}})",
                           R"("wood": {"file": "wood.png", "wrap": "clamp", "wrapV": "black", "filter": "trilinear",
    "uvScale": 2, "uvRotation": 90, "uvOffset": [0, 1]})");
  const auto& plastic = loaded.as<PlasticMaterial>();
  CHECK(plastic.diffuseReflectance.value == Spectrum(0.5f));
  CHECK(plastic.roughness->alpha.value == 0.2f);
  const BitmapTexture& color = loaded.bitmap(plastic.diffuseReflectance.texture);
  CHECK(color.encoding == TextureEncoding::Srgb);
  CHECK(color.filter == TextureFilter::Trilinear);
  CHECK(color.wrapU == TextureWrap::Clamp);
  CHECK(color.wrapV == TextureWrap::Black);
  CHECK(loaded.bitmap(plastic.roughness->alpha.texture).encoding == TextureEncoding::Linear);
  CHECK(maps(loaded.texture(0).uvTransform, {1, 0}, {0, 3}));
  CHECK(maps(loaded.texture(0).uvTransform, {0, 1}, {-2, 1}));

  const auto board = json(R"({"type": "diffuse", "reflectance": {"texture": {"type": "checkerboard", "color0": 1}}})");
  CHECK(std::get<CheckerboardTexture>(board.texture(0).kind).color0 == Spectrum(1.0f));
  const auto mask = json(R"({"type": "mask", "material": {"type": "roughDiffuse", "alpha": 0.4},
    "opacity": {"texture": {"file": "wood.png", "channel": "alpha", "encoding": "srgb"}}})");
  CHECK(mask.bitmap(mask.as<MaskMaterial>().opacity.texture).channel == TextureChannel::Alpha);
  CHECK(mask.bitmap(0).encoding == TextureEncoding::Srgb);
  CHECK(materialAs<RoughDiffuseMaterial>(mask.scene, mask.as<MaskMaterial>().material).alpha.value == 0.4f);
}

TEST_CASE_METHOD(Fixture, "scene.json: textures that cannot be") {
  const auto error = [&](const std::string& texture) {
    return jsonError(R"({"type": "diffuse", "reflectance": {"texture": )" + texture + "}}",
                     R"("wood": {"file": "wood.png"})");
  };
  CHECK(error("\"wod\"") ==
        "a.json#/shapes/0/material/reflectance/texture: there is no texture 'wod'; did you mean 'wood'?");
  CHECK(error(R"({"file": "absent.png"})") ==
        "a.json#/shapes/0/material/reflectance/texture/file: there is no file 'absent.png'");
  CHECK_THAT(error(R"({"type": "checkerboard", "file": "wood.png"})"), Catch::Contains("texture/file"));
  CHECK_THAT(error(R"({"file": "wood.png", "uvScale": [1, 2, 3]})"), Catch::Contains("two numbers [u, v]"));
  CHECK_THAT(jsonError(R"({"type": "diffuse", "reflectance": {"texture": "wood", "scal": 2}})", R"("wood": {})"),
             Catch::Contains("scal"));
}

TEST_CASE_METHOD(Fixture, "Mitsuba: blend, bump and normal maps, stretched roughness") {
  const auto blend = mitsuba(R"(<bsdf type="blendbsdf"><float name="weight" value="0.3"/><bsdf type="diffuse"/>
    <bsdf type="conductor"/></bsdf>)");
  CHECK(blend.as<BlendMaterial>().weight.value == 0.3f);
  materialAs<DiffuseMaterial>(blend.scene, blend.as<BlendMaterial>().first);
  materialAs<ConductorMaterial>(blend.scene, blend.as<BlendMaterial>().second);
  CHECK_THAT(mitsubaError(R"(<bsdf type="blendbsdf"><bsdf type="diffuse"/></bsdf>)"), Catch::Contains("two bsdfs"));

  const auto bump = mitsuba("<bsdf type=\"bumpmap\"><texture name=\"map\" type=\"bitmap\">" + kWood +
                            "</texture><float name=\"scale\" value=\"3\"/><bsdf type=\"diffuse\"/></bsdf>");
  CHECK(bump.as<BumpMaterial>().scale == Approx(3));
  CHECK(bump.as<BumpMaterial>().texture == 0);
  const auto normals = mitsuba("<bsdf type=\"normalmap\"><texture type=\"bitmap\">" + kWood +
                               "<boolean name=\"raw\" value=\"true\"/></texture><bsdf type=\"diffuse\"/></bsdf>");
  CHECK(normals.as<NormalMapMaterial>().texture == 0);
  CHECK(normals.bitmap(0).encoding == TextureEncoding::Linear);
  CHECK_THAT(mitsubaError(R"(<bsdf type="bumpmap"><bsdf type="diffuse"/></bsdf>)"), Catch::Contains("one texture"));

  const auto stretched = mitsuba(R"(<bsdf type="roughconductor"><float name="alpha_u" value="0.1"/>
    <float name="alpha_v" value="0.3"/></bsdf>)");
  CHECK(stretched.as<ConductorMaterial>().roughness->alpha.value == 0.1f);
  CHECK(stretched.as<ConductorMaterial>().roughness->alphaV->value == 0.3f);
}

TEST_CASE_METHOD(Fixture, "Mitsuba: principled") {
  const auto m = mitsuba(R"(<bsdf type="principled"><rgb name="base_color" value="0.8 0.4 0.2"/>
    <float name="metallic" value="0.7"/><float name="specular" value="0.5"/><float name="roughness" value="0.2"/>
    <float name="spec_tint" value="1"/><float name="clearcoat" value="0.6"/><float name="clearcoat_gloss" value="0"/>
    <float name="spec_trans" value="0.4"/><float name="sheen" value="0.3"/></bsdf>)")
                     .as<PrincipledMaterial>();
  CHECK(m.baseColor.value.y == 0.4f);
  CHECK(m.metallic.value == 0.7f);
  CHECK(m.roughness.value == 0.2f);
  CHECK(m.ior == Approx(1.5f));
  CHECK(isNear(m.specular.value, Spectrum(1, 0.5f, 0.25f)));
  CHECK(m.clearcoat.value == Approx(0.15f));
  CHECK(m.clearcoatRoughness.value == Approx(std::sqrt(0.1f)));
  CHECK(m.transmission.value == 0.4f);
  CHECK(isNear(m.sheen.value, Spectrum(0.3f)));
  CHECK_THAT(mitsubaError(R"(<bsdf type="principled"><float name="flatness" value="1"/></bsdf>)"),
             Catch::Contains("flatness is not supported"));
}

TEST_CASE_METHOD(Fixture, "scene.json: blend, bump, normalMap, principled, stretched roughness") {
  const auto blend = json(R"({"type": "blend", "first": {"type": "diffuse"}, "weight": 0.2,
    "second": {"type": "bump", "material": {"type": "diffuse"}, "texture": {"file": "wood.png"}, "scale": 0.1}})");
  CHECK(blend.as<BlendMaterial>().weight.value == 0.2f);
  const auto& bump = materialAs<BumpMaterial>(blend.scene, blend.as<BlendMaterial>().second);
  CHECK(bump.scale == 0.1f);
  CHECK(blend.bitmap(bump.texture).encoding == TextureEncoding::Linear);
  json(R"({"type": "normalMap", "material": {"type": "diffuse"}, "texture": {"file": "wood.png"}})")
      .as<NormalMapMaterial>();

  const auto m = json(R"({"type": "principled", "baseColor": [0.8, 0.4, 0.2], "metallic": 0.1, "roughness": 0.3,
    "anisotropy": 0.4, "ior": "water", "specular": 0.9, "transmission": 0.5, "thin": true, "sheen": 0.2,
    "clearcoat": 0.6, "clearcoatRoughness": {"texture": {"file": "wood.png"}}})")
                     .as<PrincipledMaterial>();
  CHECK(m.ior == Approx(1.333f));
  CHECK(m.anisotropy == 0.4f);
  CHECK(m.thin);
  CHECK(m.clearcoatRoughness.texture == 0);

  const auto metal = json(R"({"type": "conductor", "alpha": 0.1, "alphaV": 0.4})").as<ConductorMaterial>();
  CHECK(metal.roughness->alphaV->value == 0.4f);
  CHECK_THAT(jsonError(R"({"type": "conductor", "alphaV": 0.4})"), Catch::Contains("give 'alpha' too"));
}
