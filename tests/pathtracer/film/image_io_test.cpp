#include "film/image_io.h"

#include <OpenImageIO/imageio.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>

#include "catch.h"
#include "core/error.h"
#include "film/exr_header.h"
#include "film/png_header.h"

using namespace pt;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// A folder that is gone after the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("guiding_image_io_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = Spectrum(0.1f * float(x), 1e-3f + float(y), 1e4f * float(x * y));
  return image;
}

}  // namespace

TEST_CASE("Floats written to an EXR come back to the bit") {
  const Folder folder;
  const Image image = gradient(7, 5);
  writeExr(folder.path / "a.exr", image);
  const Image back = readImage(folder.path / "a.exr");
  REQUIRE(back.width == 7);
  REQUIRE(back.height == 5);
  CHECK(back.pixels == image.pixels);
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);  // no temporary file is left
}

TEST_CASE("Half floats keep three digits in half the space") {
  const Folder folder;
  Image image(128, 128);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Spectrum(std::sqrt(float(i)));
  ExrOptions options;
  options.half = true;
  writeExr(folder.path / "half.exr", image, options);
  writeExr(folder.path / "float.exr", image);
  const Image back = readImage(folder.path / "half.exr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    REQUIRE(back.pixels[i].x == Approx(image.pixels[i].x).epsilon(1e-3));
  CHECK(fs::file_size(folder.path / "half.exr") < fs::file_size(folder.path / "float.exr"));
}

TEST_CASE("Layers and attributes stand beside the colours") {
  const Folder folder;
  const Image image = gradient(4, 3);
  Image normal(4, 3), depth(4, 3);
  normal.at(1, 2) = Spectrum(0.25f, -0.5f, 0.75f);
  depth.at(1, 2) = Spectrum(42.0f);
  ExrOptions options;
  options.attributes = {{"scene", "cbox"}, {"spp", 127}, {"seconds", 1.5f}};
  options.layers = {{"normal", "XYZ", &normal}, {"depth", "Z", &depth}};
  writeExr(folder.path / "a.exr", image, options);

  CHECK(readImage(folder.path / "a.exr").pixels == image.pixels);
  const auto input = OIIO::ImageInput::open((folder.path / "a.exr").string());
  REQUIRE(input);
  const OIIO::ImageSpec spec = input->spec();
  CHECK(spec.nchannels == 7);
  CHECK(spec.get_string_attribute("scene") == "cbox");
  CHECK(spec.get_int_attribute("spp") == 127);
  CHECK(spec.get_float_attribute("seconds") == 1.5f);
  std::vector<float> values(std::size_t(4 * 3 * spec.nchannels));
  REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()));
  const auto value = [&](const char* channel) {
    REQUIRE(spec.channelindex(channel) >= 0);
    return values[std::size_t((2 * 4 + 1) * spec.nchannels + spec.channelindex(channel))];
  };
  CHECK(value("normal.X") == 0.25f);
  CHECK(value("normal.Y") == -0.5f);
  CHECK(value("normal.Z") == 0.75f);
  CHECK(value("depth.Z") == 42);
}

TEST_CASE("A PNG is an sRGB preview: exposed, clamped, and read back linear") {
  const Folder folder;
  Image image(4, 1);
  image.at(0, 0) = Spectrum(0.25f, 0.5f, 0);
  image.at(1, 0) = Spectrum(100, -1, std::numeric_limits<float>::quiet_NaN());
  image.at(2, 0) = Spectrum(0.001f);
  writePng(folder.path / "a.png", image);
  const Image back = readImage(folder.path / "a.png");
  CHECK(back.at(0, 0).x == Approx(0.25).epsilon(0.02));
  CHECK(back.at(0, 0).y == Approx(0.5).epsilon(0.02));
  CHECK(back.at(1, 0) == Spectrum(1, 0, 0));
  CHECK(back.at(2, 0).x == Approx(0.001).epsilon(0.2));

  writePng(folder.path / "b.png", image, 1);
  CHECK(readImage(folder.path / "b.png").at(0, 0).x == Approx(0.5).epsilon(0.02));
}

TEST_CASE("Files that are no pictures are refused by name") {
  const Folder folder;
  CHECK_THROWS_AS(readImage(folder.path / "none.exr"), InputError);
  CHECK_THROWS_WITH(readImage(folder.path / "none.exr"), Contains("none.exr") && Contains("no such file"));
  std::ofstream(folder.path / "text.exr") << "not a picture";
  CHECK_THROWS_WITH(readImage(folder.path / "text.exr"), Contains("text.exr"));

  writeExr(folder.path / "whole.exr", gradient(64, 64));
  std::ifstream whole(folder.path / "whole.exr", std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(whole)), {});
  std::ofstream(folder.path / "cut.exr", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  CHECK_THROWS_AS(readImage(folder.path / "cut.exr"), InputError);
}

TEST_CASE("Gigantic pictures that a file announces and does not have are refused before memory is taken") {
  const Folder folder;
  writeExr(folder.path / "small.exr", gradient(64, 64));
  std::ifstream small(folder.path / "small.exr", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(small)), {});
  const std::string window("\0\0\0\0\0\0\0\0\x3f\0\0\0\x3f\0\0\0", 16);  // 0, 0 to 63, 63
  for (const int side : {16'384, 1'000'000, 0x7fffffff}) {
    std::string forged = bytes, huge = window;
    const std::int32_t last = side - 1;
    for (const std::size_t at : {8, 12}) huge.replace(at, 4, reinterpret_cast<const char*>(&last), 4);
    int windows = 0;
    for (std::size_t at = forged.find(window); at != std::string::npos; at = forged.find(window)) {
      forged.replace(at, 16, huge);
      ++windows;
    }
    REQUIRE(windows == 2);  // of the data and of the display
    std::ofstream(folder.path / "huge.exr", std::ios::binary) << forged;
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    CHECK_THROWS_AS(readImage(folder.path / "huge.exr"), InputError);
    getrusage(RUSAGE_SELF, &after);
    CHECK(after.ru_maxrss - before.ru_maxrss < 200'000);  // kB; the pixels would take 3 GB
  }
  // A picture that is as large as it says, however well it is packed.
  writeExr(folder.path / "flat.exr", Image(4096, 1024), {true, {}, {}});
  CHECK(fs::file_size(folder.path / "flat.exr") < 4096 * 1024 * 6 / 200);
  CHECK(readImage(folder.path / "flat.exr").width == 4096);
}

TEST_CASE("A header of attributes that are larger than the file is refused, wherever it is cut") {
  const Folder folder;
  const fs::path whole = folder.path / "whole.exr", cut = folder.path / "cut.exr";
  writeExr(whole, gradient(4, 4));
  std::ifstream stream(whole, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  CHECK(!faultOfExrHeader(stream));
  std::string forged = bytes;
  const std::size_t at = forged.find("chlist") + 7;  // the attribute's size
  REQUIRE(at < forged.size());
  forged.replace(at, 4, "\xf0\xff\xff\x6f");
  std::ofstream(cut, std::ios::binary) << forged;
  CHECK_THROWS_WITH(readImage(cut), Contains("attribute 'channels' is cut short: 1879048176 bytes are announced"));

  // Sizes that fit into the file, but not the values.
  const auto withSize = [&](const char* type, char size) {
    std::string wrong = bytes;
    wrong[wrong.find(type) + std::string_view(type).size() + 1] = size;
    std::ofstream(cut, std::ios::binary) << wrong;
  };
  for (const auto& [type, name] :
       {std::pair("chlist", "channels"), std::pair("box2i", "dataWindow"), std::pair("v2f", "screenWindowCenter")}) {
    withSize(type, 3);
    CHECK_THROWS_WITH(readImage(cut),
                      Contains(std::string("attribute '") + name + "'") && Contains("cannot take 3 bytes"));
  }
  for (std::size_t size = 0; size < bytes.size(); size += 3) {
    std::ofstream(cut, std::ios::binary | std::ios::trunc) << bytes.substr(0, size);
    CHECK_THROWS_AS(readImage(cut), InputError);
  }
}

TEST_CASE("A PNG file with a chunk that is larger than the file is refused before memory is taken for it") {
  const Folder folder;
  const fs::path whole = folder.path / "whole.png", cut = folder.path / "cut.png";
  writePng(whole, gradient(16, 16), 0);
  std::ifstream stream(whole, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  CHECK(!faultOfPngChunks(stream));
  std::string forged = bytes;
  const std::size_t at = forged.find("IDAT");
  REQUIRE(at < forged.size());
  forged.replace(at - 4, 4, "MMMM");
  std::ofstream(cut, std::ios::binary) << forged;
  CHECK_THROWS_WITH(readImage(cut), Contains("chunk 'IDAT' is cut short: 1296911693 bytes are announced"));
  std::ofstream(cut, std::ios::binary | std::ios::trunc) << bytes.substr(0, at + 8);
  CHECK_THROWS_WITH(readImage(cut), Contains("cut.png") && Contains("chunk 'IDAT' is cut short"));
}

TEST_CASE("Devices, pipes and folders are no pictures") {
  const Folder folder;
  mkfifo((folder.path / "pipe.exr").c_str(), 0600);
  fs::create_directory(folder.path / "folder.exr");
  for (const fs::path& path : {fs::path("/dev/zero"), folder.path / "pipe.exr", folder.path / "folder.exr"})
    CHECK_THROWS_WITH(readImage(path), Contains("it is no file but a folder, a device or a pipe"));
}

TEST_CASE("A failed write tells path and reason and keeps the old file") {
  const Folder folder;
  const fs::path file = folder.path / "a.exr";
  const Image old = gradient(3, 3);
  writeExr(file, old);

  // No file may grow beyond 4 KiB: as good as a full disk.
  rlimit limit{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &limit) == 0);
  const rlimit small{4096, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  Image large(512, 512);
  for (std::size_t i = 0; i < large.pixels.size(); ++i) large.pixels[i] = Spectrum(std::sin(float(i)));
  std::string message;
  try {
    writeExr(file, large);
  } catch (const WorkError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);

  CHECK_THAT(message, Contains("a.exr") && Contains("cannot be written"));
  CHECK(readImage(file).pixels == old.pixels);
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);
  CHECK_THROWS(writeExr(folder.path / "missing" / "a.exr", old));
}
