#include "loader_fixture.h"

using namespace pt;
using namespace pt::test;

namespace {

Matrix4 transformOf(const std::string& steps, const std::string& version = "3.0.0") {
  SceneFolder folder;
  const auto scene = folder.load(
      "a.xml",
      mitsubaScene("<shape type=\"cube\"><transform name=\"to_world\">" + steps + "</transform></shape>", version));
  return scene.shapes.at(0).toWorld;
}

std::string errorOf(const std::string& steps) {
  SceneFolder folder;
  return folder.errorOf(
      "a.xml", mitsubaScene("<shape type=\"cube\"><transform name=\"to_world\">\n" + steps + "</transform></shape>"));
}

}  // namespace

TEST_CASE("single steps of a transform") {
  const Vec3 p(1, 2, 3);
  CHECK(isNear(apply(transformOf(""), p), p));
  CHECK(isNear(apply(transformOf(R"(<translate x="10" z="-1"/>)"), p), Vec3(11, 2, 2)));
  CHECK(isNear(apply(transformOf(R"(<translate value="1, 2 3"/>)"), p), Vec3(2, 4, 6)));
  CHECK(isNear(apply(transformOf(R"(<scale value="2"/>)"), p), Vec3(2, 4, 6)));
  CHECK(isNear(apply(transformOf(R"(<scale value="2, 3, 4"/>)"), p), Vec3(2, 6, 12)));
  CHECK(isNear(apply(transformOf(R"(<scale y="5"/>)"), p), Vec3(1, 10, 3)));
  CHECK(isNear(apply(transformOf(R"(<rotate z="1" angle="90"/>)"), p), Vec3(-2, 1, 3)));
  CHECK(isNear(apply(transformOf(R"(<rotate value="0 3 0" angle="-90"/>)"), p), Vec3(-3, 2, 1)));
}

TEST_CASE("steps apply in the order of the file") {
  CHECK(isNear(apply(transformOf(R"(<translate x="1"/><scale value="2"/>)"), Vec3(0, 0, 0)), Vec3(2, 0, 0)));
  CHECK(isNear(apply(transformOf(R"(<scale value="2"/><translate x="1"/>)"), Vec3(0, 0, 0)), Vec3(1, 0, 0)));
}

TEST_CASE("matrices are given for column vectors, row by row") {
  const Matrix4 m = transformOf(R"(<matrix value="1 0 0 10, 0 0 -1 20, 0 1 0 30, 0 0 0 1"/>)");
  CHECK(isNear(apply(m, Vec3(1, 2, 3)), Vec3(11, 17, 32)));
  const Matrix4 linear = transformOf(R"(<matrix value="1 2 0  0 1 0  0 0 1"/>)");
  CHECK(isNear(apply(linear, Vec3(1, 2, 3)), Vec3(5, 2, 3)));
}

TEST_CASE("lookAt in both spellings: z to the target, x to the viewer's left") {
  for (const char* tag : {"lookat", "lookAt"}) {
    const Matrix4 m =
        transformOf(std::string("<") + tag + R"( origin="1, 2, 3" target="1, 2, 13" up="0, 7, 0"/>)", "0.6.0");
    CHECK(isNear(apply(m, Vec3(0, 0, 0)), Vec3(1, 2, 3)));
    CHECK(isNear(apply(m, Vec3(0, 0, 1)), Vec3(1, 2, 4)));
    CHECK(isNear(apply(m, Vec3(0, 1, 0)), Vec3(1, 3, 3)));
    CHECK(isNear(apply(m, Vec3(1, 0, 0)), Vec3(2, 2, 3)));  // looking along +z with y up, +x is on the left
  }
  const Matrix4 noUp = transformOf(R"(<lookat origin="0 0 0" target="0 5 0"/>)");
  CHECK(isNear(apply(noUp, Vec3(0, 0, 1)), Vec3(0, 1, 0)));
}

TEST_CASE("impossible transforms") {
  CHECK(errorOf(R"(<rotate angle="90"/>)") == "a.xml:3: <rotate>: the axis has no length");
  CHECK(errorOf(R"(<rotate x="1"/>)") == "a.xml:3: <rotate> lacks the attribute 'angle'");
  CHECK(errorOf(R"(<rotate x="1" angel="3"/>)") == "a.xml:3: <rotate> has no attribute 'angel'; did you mean 'angle'?");
  CHECK(errorOf(R"(<matrix value="1 2 3"/>)") == "a.xml:3: <matrix> holds 3 numbers; it takes 16 (or 9)");
  CHECK(errorOf(R"(<lookat origin="0 0 0" target="0 0 0"/>)") ==
        "a.xml:3: <lookat>: origin and target coincide, or 'up' points along the view");
  CHECK(errorOf(R"(<lookat origin="0 0 0" target="0 1 0" up="0 1 0"/>)")
            .starts_with("a.xml:3: <lookat>: origin and target coincide"));
  CHECK(errorOf(R"(<translate x="nan"/>)") == "a.xml:3: <translate>: 'nan' is not a finite number");
  CHECK(errorOf(R"(<translate value="1 2"/>)") == "a.xml:3: <translate>: '1 2' is not three numbers");
  CHECK(errorOf(R"(<shear x="1"/>)").starts_with("a.xml:3: <transform> takes no <shear>; known: translate"));
}
