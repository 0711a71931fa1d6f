#include "textures/texture_set.h"

#include <sys/resource.h>
#include <zlib.h>

#include <cstdint>
#include <fstream>
#include <iterator>

#include "catch.h"
#include "core/error.h"
#include "picture_folder.h"
#include "statistics/random.h"

using namespace pt;
using namespace test;

namespace {

float srgb(int byte) {
  return srgbToLinear(float(byte) / 255);
}

/// 4 x 2 texels, all different.
const std::vector<std::uint8_t> kColors = {10,  20,  30,  40,  50,  60,  70,  80,  90,  100, 110, 120,
                                           130, 140, 150, 160, 170, 180, 190, 200, 210, 220, 230, 255};

Spectrum colorOf(int x, int y) {
  const std::uint8_t* texel = &kColors[std::size_t(3 * (4 * y + x))];
  return {srgb(texel[0]), srgb(texel[1]), srgb(texel[2])};
}

/// The middle of a texel.
TexturePoint middle(float x, float y) {
  return {{(x + 0.5f) / 4, (y + 0.5f) / 2}, 0};
}

bool isNear(const Spectrum& a, const Spectrum& b, float tolerance = 1e-6f) {
  return (a - b).length() <= tolerance;
}

struct Fixture {
  PictureFolder folder;
  BitmapTexture bitmap{.file = folder.write("colors.png", 4, 2, 3, kColors)};

  Spectrum read(const TexturePoint& point, const Matrix3& uvTransform = Matrix3()) const {
    return TextureSet(sceneWith(bitmap, uvTransform)).find(0)->color(point);
  }
};

std::string errorOf(const BitmapTexture& bitmap) {
  try {
    TextureSet(sceneWith(bitmap));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE_METHOD(Fixture, "a bitmap has its texels at their middles and mixes light between them") {
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) CHECK(isNear(read(middle(float(x), float(y))), colorOf(x, y)));
  CHECK(isNear(read(middle(1.25f, 0)), colorOf(1, 0) * 0.75f + colorOf(2, 0) * 0.25f));
  CHECK(isNear(read(middle(2, 0.5f)), (colorOf(2, 0) + colorOf(2, 1)) * 0.5f));
  bitmap.filter = TextureFilter::Nearest;
  CHECK(isNear(read(middle(1.4f, 0.4f)), colorOf(1, 0)));
  CHECK(isNear(read(middle(1.6f, 0.6f)), colorOf(2, 1)));
}

TEST_CASE_METHOD(Fixture, "one number of a bitmap is its luminance, or a channel") {
  const auto number = [&] { return TextureSet(sceneWith(bitmap)).find(0)->number(middle(1, 1)); };
  CHECK(number() == Approx(luminance(colorOf(1, 1))));
  bitmap.channel = TextureChannel::Green;
  CHECK(number() == Approx(colorOf(1, 1).y));
  CHECK(isNear(read(middle(1, 1)), Spectrum(colorOf(1, 1).y)));
  bitmap.encoding = TextureEncoding::Linear;
  CHECK(number() == Approx(170 / 255.0f));
}

TEST_CASE_METHOD(Fixture, "outside of the picture") {
  const auto at = [&](TextureWrap wrap, float x) {
    bitmap.wrapU = bitmap.wrapV = wrap;
    return read(middle(x, 0));
  };
  using enum TextureWrap;
  CHECK(isNear(at(Repeat, -1), colorOf(3, 0)));
  CHECK(isNear(at(Repeat, 9), colorOf(1, 0)));
  CHECK(isNear(at(Repeat, 3.5f), (colorOf(3, 0) + colorOf(0, 0)) * 0.5f));
  CHECK(isNear(at(Mirror, -1), colorOf(0, 0)));
  CHECK(isNear(at(Mirror, 5), colorOf(2, 0)));
  CHECK(isNear(at(Mirror, 9), colorOf(1, 0)));
  CHECK(isNear(at(Clamp, -7), colorOf(0, 0)));
  CHECK(isNear(at(Clamp, 7), colorOf(3, 0)));
  CHECK(isNear(at(Black, -7), Spectrum(0.0f)));
  CHECK(isNear(at(Black, 3.5f), colorOf(3, 0) * 0.5f));
  CHECK(isNear(at(Black, -0.5f), colorOf(0, 0) * 0.5f));
  for (const auto wrap : {Repeat, Mirror, Clamp, Black})
    for (const float x : {1e9f, -1e9f, std::numeric_limits<float>::infinity(), std::nanf("")})
      CHECK(at(wrap, x).x <= 1);  // anything, but something
}

TEST_CASE_METHOD(Fixture, "texture coordinates are scaled, turned and moved") {
  const TexturePoint origin = middle(0, 0);
  CHECK(isNear(read(origin, Matrix3(3, 0, 0, 0, 3, 0, 0, 0, 1)), read(middle(1, 1))));
  CHECK(isNear(read(origin, Matrix3(1, 0, 0, 0, 1, 0, 0.25f, 0, 1)), colorOf(1, 0)));
  CHECK(isNear(read({{0.25f, 0.125f}}, Matrix3(0, 1, 0, 1, 0, 0, 0, 0, 1)), read({{0.125f, 0.25f}})));
  CHECK_THROWS_WITH(TextureSet(sceneWith(bitmap, Matrix3(0.0f))), Catch::Contains("affine"));
}

TEST_CASE("trilinear bitmaps are as sharp as the pixel and no sharper") {
  PictureFolder folder;
  constexpr int kSize = 64;
  std::vector<std::uint8_t> stripes;
  for (int i = 0; i < kSize * kSize; ++i) stripes.push_back(i % 2 == 0 ? 0 : 255);
  const BitmapTexture bitmap{.file = folder.write("stripes.png", kSize, kSize, 1, stripes),
                             .filter = TextureFilter::Trilinear};
  const TextureSet textures(sceneWith(bitmap));
  const auto at = [&](float width) { return textures.find(0)->number({{1.5f / kSize, 0.5f}, width}); };
  CHECK(at(0) == Approx(1));
  CHECK(at(1.0f / kSize) == Approx(1));
  CHECK(at(std::sqrt(2.0f) / kSize) == Approx(0.75f).epsilon(0.01));
  // Half of the light, not half of the code.
  for (const float width : {2.0f / kSize, 0.3f, 1.0f, 1e9f}) CHECK(at(width) == Approx(0.5f).epsilon(0.01));
}

TEST_CASE("pictures that memory has no room for are read through a cache, to the same result") {
  PictureFolder folder;
  Random random(1);
  const auto noise = [&](auto one, int channels) {
    std::vector<decltype(one)> values;
    for (int i = 0; i < 150 * 130 * channels; ++i) values.push_back(decltype(one)(random.next1D() * float(one)));
    return values;
  };
  const std::filesystem::path files[] = {folder.write("rgb.png", 150, 130, 3, noise(std::uint8_t(255), 3)),
                                         folder.write("gray.png", 150, 130, 1, noise(std::uint8_t(255), 1)),
                                         folder.write("deep.png", 150, 130, 3, noise(std::uint16_t(65535), 3)),
                                         folder.write("hdr.exr", 150, 130, 3, noise(7.0f, 3))};
  for (const auto& file : files) {
    CAPTURE(file.filename().string());
    SceneDescription scene = sceneWith({.file = file, .wrapV = TextureWrap::Clamp});
    const TextureSet inMemory(scene);
    scene.textureMemoryBytes = 0;
    const TextureSet cached(scene);
    CHECK(inMemory.memoryBytes() > 0);
    CHECK(inMemory.cachedPictures() == 0);
    CHECK(cached.memoryBytes() == 0);
    CHECK(cached.cachedPictures() == 1);
    CHECK(isNear(inMemory.find(0)->range().mean, cached.find(0)->range().mean, 1e-5f));
    CHECK(isNear(inMemory.find(0)->range().most, cached.find(0)->range().most));
    int different = 0;
    for (int i = 0; i < 2000; ++i) {
      const TexturePoint point{random.next2D() * 3.0f - Vec2(1, 1)};
      different += !isNear(inMemory.find(0)->color(point), cached.find(0)->color(point));
    }
    CHECK(different == 0);
  }
}

TEST_CASE("a file that is cut while it is read through the cache has black texels, and that is counted") {
  PictureFolder folder;
  constexpr int kSize = 3000;  // more texels than the cache holds
  const auto file = folder.write("cut.exr", kSize, kSize, 3, std::vector<float>(3 * kSize * kSize, 0.5f));
  SceneDescription scene = sceneWith({.file = file, .filter = TextureFilter::Nearest});
  scene.textureMemoryBytes = 0;
  const TextureSet textures(scene);
  CHECK(textures.failedReads() == 0);
  std::filesystem::resize_file(file, 1000);
  int black = 0;
  for (int y = 32; y < kSize; y += 64) black += isBlack(textures.find(0)->color({{0.5f, float(y) / kSize}})) ? 1 : 0;
  CHECK(black > 10);
  CHECK(textures.failedReads() > 10);
}

TEST_CASE("pictures are read once, whatever reads them") {
  PictureFolder folder;
  const BitmapTexture bitmap{.file = folder.write("colors.png", 4, 2, 3, kColors)};
  SceneDescription scene = sceneWith(bitmap);
  scene.textures.push_back({bitmap, Matrix3(2, 0, 0, 0, 2, 0, 0, 0, 1), "b"});
  CHECK(TextureSet(scene).memoryBytes() == 24);
}

TEST_CASE("transparent texels keep their colour, and alpha is linear") {
  PictureFolder folder;
  const std::vector<std::uint8_t> texels = {200, 100, 50, 128, 200, 100, 50, 0};
  BitmapTexture bitmap{.file = folder.write("leaf.png", 2, 1, 4, texels)};
  const auto at = [&](float x) { return TextureSet(sceneWith(bitmap)).find(0)->color({{(x + 0.5f) / 2, 0.5f}}); };
  CHECK(isNear(at(0), Spectrum(srgb(200), srgb(100), srgb(50))));
  CHECK(isNear(at(1), at(0)));
  bitmap.channel = TextureChannel::Alpha;
  CHECK(isNear(at(0), Spectrum(128 / 255.0f)));
  CHECK(isNear(at(1), Spectrum(0.0f)));
}

TEST_CASE("a checkerboard") {
  SceneDescription scene;
  scene.textures.push_back({CheckerboardTexture{Spectrum(0.8f), Spectrum(0.1f, 0.2f, 0.3f)}, Matrix3(), "test"});
  const TextureSet textures(scene);
  const Texture& board = *textures.find(0);
  CHECK(board.color({{0.25f, 0.25f}}) == Spectrum(0.8f));
  CHECK(board.color({{0.75f, 0.75f}}) == Spectrum(0.8f));
  CHECK(board.color({{0.75f, 0.25f}}) == Spectrum(0.1f, 0.2f, 0.3f));
  CHECK(board.color({{-0.25f, 3.25f}}) == Spectrum(0.1f, 0.2f, 0.3f));
  CHECK(board.number({{0.25f, 0.25f}}) == Approx(0.8f));
  CHECK(isNear(board.range().mean, Spectrum(0.45f, 0.5f, 0.55f)));
}

TEST_CASE("pictures that cannot be textures are input errors that name scene, file and reason") {
  PictureFolder folder;
  CHECK_THAT(errorOf({.file = folder / "absent.png"}),
             Catch::StartsWith("test#/textures/0: ") && Catch::Contains("absent.png: cannot be read as a picture"));
  const auto opaque = folder.write("colors.png", 4, 2, 3, kColors);
  CHECK_THAT(errorOf({.file = opaque, .channel = TextureChannel::Alpha}), Catch::Contains("no alpha channel"));
  const auto broken = folder.write<float>("nan.exr", 1, 1, 3, {1, std::nanf(""), 1});
  CHECK_THAT(errorOf({.file = broken}), Catch::Contains("NaN or infinite"));
  std::filesystem::resize_file(opaque, std::filesystem::file_size(opaque) / 2);
  CHECK_THAT(errorOf({.file = opaque}), Catch::Contains("colors.png: "));
}

TEST_CASE("pictures that announce more than they have are refused before memory is taken, in files and within others") {
  PictureFolder folder;
  const auto whole = folder.write("colors.png", 4, 2, 3, kColors);
  std::ifstream stream(whole, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  const auto bigEndian = [](std::uint32_t number) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += char(number >> shift & 0xff);
    return text;
  };
  const auto check = [&](const std::string& forged, const std::string& reason) {
    BitmapTexture bitmap{.file = folder / "forged.png"};
    std::ofstream(bitmap.file, std::ios::binary) << forged;
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    CHECK_THAT(errorOf(bitmap), Catch::Contains("forged.png: cannot be read as a picture: " + reason));
    bitmap.bytes = std::make_shared<std::string>(forged);
    CHECK_THAT(errorOf(bitmap), Catch::Contains("forged.png: cannot be read as a picture: " + reason));
    getrusage(RUSAGE_SELF, &after);
    CHECK(after.ru_maxrss - before.ru_maxrss < 100'000);  // kB
  };
  std::string longChunk = bytes;
  longChunk.replace(longChunk.find("IDAT") - 4, 4, "MMMM");
  check(longChunk, "its chunk 'IDAT' is cut short: 1296911693 bytes are announced");

  const std::size_t header = bytes.find("IHDR");
  for (const auto& [side, interlace] : {std::pair(16'000u, 0), std::pair(16'000u, 1), std::pair(1'000'000u, 0)}) {
    std::string huge = bytes;
    huge.replace(header + 4, 8, bigEndian(side) + bigEndian(side));
    huge[header + 16] = char(interlace);
    const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(&huge[header]), 17);
    huge.replace(header + 17, 4, bigEndian(std::uint32_t(checksum)));
    CAPTURE(side, interlace);
    check(huge, "");
  }
}

TEST_CASE("pictures within other files") {
  PictureFolder folder;
  for (const char* name : {"colors.png", "colors.jpg"}) {
    CAPTURE(name);
    const BitmapTexture file{.file = folder.write(name, 4, 2, 3, kColors)};
    std::ifstream stream(file.file, std::ios::binary);
    BitmapTexture embedded{.file = "model.glb#/images/0"};
    embedded.bytes =
        std::make_shared<std::string>(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    SceneDescription scene = sceneWith(file);
    scene.textures.push_back({embedded, Matrix3(), "test#/textures/1"});
    scene.textureMemoryBytes = 0;  // as if there were no room: there is no file to read tiles from
    const TextureSet textures(scene);
    for (const float x : {0.0f, 1.3f, 3.0f})
      CHECK(isNear(textures.find(0)->color(middle(x, 1)), textures.find(1)->color(middle(x, 1))));
    embedded.bytes = std::make_shared<std::string>(embedded.bytes->substr(0, embedded.bytes->size() / 2));
    CHECK_THAT(errorOf(embedded), Catch::Contains("test#/textures/0: model.glb#/images/0: "));
  }
  BitmapTexture nonsense{.file = "model.glb#/images/0"};
  nonsense.bytes = std::make_shared<std::string>("no picture");
  CHECK_THAT(errorOf(nonsense), Catch::Contains("model.glb#/images/0: cannot be read as a picture"));
}
