#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

/// A scene with one sphere of that BSDF, which is materials.back().
SceneDescription withBsdf(const std::string& bsdf, const std::string& version = "3.0.0",
                          const LoadOptions& options = {}) {
  SceneFolder folder;
  return folder.load("a.xml", mitsubaScene("<shape type=\"sphere\">" + bsdf + "</shape>", version), options);
}

template <class Kind>
Kind bsdfAs(const std::string& bsdf, const std::string& version = "3.0.0") {
  const auto scene = withBsdf(bsdf, version);
  return materialAs<Kind>(scene, scene.shapes.at(0).material);
}

Spectrum reflectanceOf(const std::string& color) {
  return bsdfAs<DiffuseMaterial>("<bsdf type=\"diffuse\">" + color + "</bsdf>").reflectance.value;
}

std::string errorOf(const std::string& bsdf, const std::string& version = "3.0.0") {
  SceneFolder folder;
  return folder.errorOf("a.xml", mitsubaScene("<shape type=\"sphere\">\n" + bsdf + "</shape>", version));
}

}  // namespace

TEST_CASE("colours in every notation") {
  CHECK(reflectanceOf("").x == 0.5f);
  CHECK(isNear(reflectanceOf(R"(<rgb name="reflectance" value="0.1, 0.2, 0.3"/>)"), Vec3(0.1f, 0.2f, 0.3f)));
  CHECK(isNear(reflectanceOf(R"(<rgb name="reflectance" value="0.1 0.2 0.3"/>)"), Vec3(0.1f, 0.2f, 0.3f)));
  CHECK(isNear(reflectanceOf(R"(<rgb name="reflectance" value="0.25"/>)"), Vec3(0.25f)));
  CHECK(isNear(reflectanceOf(R"(<rgb name="reflectance" value="#ff8000"/>)"), Vec3(1, 128 / 255.0f, 0)));
  CHECK(isNear(reflectanceOf(R"(<srgb name="reflectance" value="#ff8000"/>)"), Vec3(1, 0.21586f, 0)));
  CHECK(isNear(reflectanceOf(R"(<spectrum name="reflectance" value="0.3"/>)"), Vec3(0.3f)));
  CHECK(isNear(reflectanceOf(R"(<float name="reflectance" value="0.3"/>)"), Vec3(0.3f)));
  // A flat spectrum of 400 to 700 nm; values of the converted Cornell box of the SD-tree's authors.
  CHECK(isNear(reflectanceOf(R"(<spectrum name="reflectance" value="400:0.78, 500:0.78, 600:0.78, 700:0.78"/>)"),
               Vec3(0.93638f, 0.74054f, 0.70524f), 2e-3f));
}

TEST_CASE("malformed colours") {
  const auto error = [](const std::string& color) { return errorOf("<bsdf type=\"diffuse\">" + color + "</bsdf>"); };
  CHECK(error(R"(<rgb name="reflectance" value="0.1, 0.2"/>)") ==
        "a.xml:3: <rgb>: '0.1, 0.2' is not a colour: one number, three numbers or #rrggbb");
  CHECK(error(R"(<rgb name="reflectance" value="a, b, c"/>)") == "a.xml:3: <rgb>: 'a' is not a finite number");
  CHECK(error(R"(<spectrum name="reflectance" value="500:1, 400:1"/>)")
            .ends_with("is not a list of wavelength:value in order of rising wavelength"));
  CHECK(error(R"(<spectrum name="reflectance" value="1 2 3"/>)")
            .ends_with("is not one number or a list of wavelength:value"));
  CHECK(error(R"(<blackbody name="reflectance" temperature="-5"/>)").ends_with("is not a temperature above 0 K"));
  CHECK(error(R"(<string name="reflectance" value="red"/>)") ==
        "a.xml:3: reflectance of bsdf 'diffuse' must be a colour, not a string");
}

TEST_CASE("conductors: presets, indices, exterior, defaults of both generations") {
  const auto mirror = bsdfAs<ConductorMaterial>("<bsdf type=\"conductor\"/>", "3.0.0");
  CHECK(mirror.eta.x == 0);
  CHECK(mirror.k.x == 1);
  CHECK_FALSE(mirror.roughness);
  // Copper is the default of Mitsuba 0.x: red by its low eta there.
  const auto copper = bsdfAs<ConductorMaterial>("<bsdf type=\"conductor\"/>", "0.5.0");
  CHECK(copper.eta.x < 0.5f);
  CHECK(copper.k.x > 3);
  const auto named =
      bsdfAs<ConductorMaterial>(R"(<bsdf type="conductor"><string name="material" value="Cu"/></bsdf>)", "3.0.0");
  CHECK(named.eta.x == Approx(copper.eta.x * 1.000277f));  // 0.x divides by air
  const auto none =
      bsdfAs<ConductorMaterial>(R"(<bsdf type="conductor"><string name="material" value="none"/></bsdf>)", "0.6.0");
  CHECK(isBlack(none.eta));

  const std::string rough =
      R"(<bsdf type="roughconductor"><float name="extEta" value="2"/><rgb name="eta" value="1,2,3"/>
    <rgb name="k" value="4"/><rgb name="specularReflectance" value="0.5"/><string name="distribution" value="GGX"/><float name="alpha" value="0.3"/>
    <boolean name="sampleVisible" value="false"/></bsdf>)";
  const auto conductor = bsdfAs<ConductorMaterial>(rough, "0.5.0");
  CHECK(isNear(conductor.eta, Vec3(0.5f, 1, 1.5f)));
  CHECK(conductor.k.y == 2);
  CHECK(conductor.specularReflectance.value.x == 0.5f);
  REQUIRE(conductor.roughness);
  CHECK(conductor.roughness->alpha.value == 0.3f);
  CHECK(conductor.roughness->distribution == MicrofacetDistribution::Ggx);
  CHECK_FALSE(conductor.roughness->sampleVisible);

  CHECK(errorOf(R"(<bsdf type="conductor"><string name="material" value="Unobtainium"/></bsdf>)") ==
        "a.xml:3: the conductor 'Unobtainium' is not known (give eta and k instead); --skip-unsupported leaves it out");
  CHECK(errorOf("<bsdf type=\"conductor\"><string name=\"material\" value=\"Cu\"/>\n<rgb name=\"eta\" "
                "value=\"1\"/></bsdf>") ==
        "a.xml:3: material of bsdf 'conductor' excludes eta and k: give one or the other");
}

TEST_CASE("roughness: default, and what we lack") {
  const auto usual = bsdfAs<ConductorMaterial>("<bsdf type=\"roughconductor\"/>");
  REQUIRE(usual.roughness);
  CHECK(usual.roughness->alpha.value == 0.1f);
  CHECK(!usual.roughness->alphaV);
  CHECK(usual.roughness->distribution == MicrofacetDistribution::Beckmann);
  CHECK(usual.roughness->sampleVisible);
  CHECK(errorOf(R"(<bsdf type="roughconductor"><string name="distribution" value="phong"/></bsdf>)") ==
        "a.xml:3: distribution 'phong' of bsdf 'roughconductor' is not supported; known: beckmann, ggx; "
        "--skip-unsupported leaves it out");
}

TEST_CASE("dielectrics: defaults, names and numbers") {
  const auto glass = bsdfAs<DielectricMaterial>("<bsdf type=\"dielectric\"/>");
  CHECK(glass.intIor == Approx(1.5046));
  CHECK(glass.extIor == Approx(1.000277));
  CHECK_FALSE(glass.roughness);
  const auto ice = bsdfAs<DielectricMaterial>(
      R"(<bsdf type="dielectric"><string name="intIOR" value="water ice"/><float name="extIOR" value="1.33"/>
    <rgb name="specularTransmittance" value="0.9"/></bsdf>)",
      "0.6.0");
  CHECK(ice.intIor == Approx(1.31));
  CHECK(ice.extIor == Approx(1.33));
  CHECK(ice.specularTransmittance.value.x == 0.9f);
  const auto rough =
      bsdfAs<DielectricMaterial>(R"(<bsdf type="roughdielectric"><integer name="int_ior" value="2"/></bsdf>)");
  CHECK(rough.intIor == 2);
  CHECK(rough.roughness);
  CHECK(bsdfAs<ThinDielectricMaterial>("<bsdf type=\"thindielectric\"/>").intIor == Approx(1.5046));
  CHECK(errorOf(R"(<bsdf type="dielectric"><string name="int_ior" value="diamant"/></bsdf>)") ==
        "a.xml:3: int_ior of bsdf 'dielectric' names no known substance: 'diamant'; did you mean 'diamond'?");
}

TEST_CASE("plastics: defaults and options") {
  const auto plastic = bsdfAs<PlasticMaterial>("<bsdf type=\"plastic\"/>");
  CHECK(plastic.intIor == Approx(1.49));
  CHECK(plastic.diffuseReflectance.value.x == 0.5f);
  CHECK_FALSE(plastic.nonlinear);
  CHECK_FALSE(plastic.roughness);
  const auto rough = bsdfAs<PlasticMaterial>(R"(<bsdf type="roughplastic"><boolean name="nonlinear" value="true"/>
    <rgb name="diffuse_reflectance" value="0.1, 0.2, 0.3"/><float name="alpha" value="0.4"/></bsdf>)");
  CHECK(rough.nonlinear);
  CHECK(isNear(rough.diffuseReflectance.value, Vec3(0.1f, 0.2f, 0.3f)));
  CHECK(rough.roughness->alpha.value == 0.4f);
}

TEST_CASE("two-sided: one side for both, or one each") {
  const auto one = withBsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/></bsdf>)");
  const auto& both = materialAs<TwoSidedMaterial>(one, one.shapes[0].material);
  CHECK(both.front == both.back);
  const auto two = withBsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="plastic"/></bsdf>)");
  const auto& sides = materialAs<TwoSidedMaterial>(two, two.shapes[0].material);
  materialAs<DiffuseMaterial>(two, sides.front);
  materialAs<PlasticMaterial>(two, sides.back);
  CHECK(errorOf("<bsdf type=\"twosided\"/>") == "a.xml:3: bsdf 'twosided' needs one or two bsdfs inside, not 0");
}

TEST_CASE("an unsupported BSDF fails, or is replaced and listed") {
  CHECK(errorOf("<bsdf type=\"hair\"/>") == "a.xml:3: bsdf 'hair' is not supported; --skip-unsupported leaves it out");
  const LoadOptions skip{true, {}};
  const auto grey = withBsdf("<bsdf type=\"hair\"/>", "3.0.0", skip);
  CHECK(materialAs<DiffuseMaterial>(grey, grey.shapes[0].material).reflectance.value.x == 0.5f);
  REQUIRE(grey.skipped.size() == 1);
  CHECK(grey.skipped[0].ends_with("a.xml:2: bsdf 'hair' is not supported: grey diffuse instead"));

  const auto unwrapped = withBsdf(R"(<bsdf type="coating"><bsdf type="plastic"/></bsdf>)", "0.5.0", skip);
  materialAs<PlasticMaterial>(unwrapped, unwrapped.shapes[0].material);
  REQUIRE(unwrapped.skipped.size() == 1);
  CHECK(unwrapped.skipped[0].ends_with("bsdf 'coating' is not supported: the bsdf inside is used as it is"));
}

TEST_CASE("a texture fails, or leaves its parameter's default") {
  const std::string bsdf = R"(<bsdf type="diffuse"><texture name="reflectance" type="gridtexture"/></bsdf>)";
  CHECK(errorOf(bsdf) == "a.xml:3: texture 'gridtexture' is not supported; --skip-unsupported leaves it out");
  const auto scene = withBsdf(bsdf, "3.0.0", {true, {}});
  CHECK(materialAs<DiffuseMaterial>(scene, scene.shapes[0].material).reflectance.value.x == 0.5f);
  CHECK(scene.skipped.size() == 1);
}
