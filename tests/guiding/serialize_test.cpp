#include <cstring>

#include "field_bytes.h"
#include "mixture_fixture.h"

using namespace guiding;
using namespace test;

namespace fs = std::filesystem;

namespace {

Field smallField(FieldSettings settings = FieldSettings::boundProduct()) {
  settings.sTreeThreshold = 200;
  settings.dTreeThreshold = 0.05f;
  return train(settings, coneRadiance, 2, 400);
}

/// What loading these bytes gives.
Result<Field> loadBytes(const Bytes& bytes) {
  const TemporaryFile file("bytes_to_load.field");
  writeBytes(file.path(), bytes);
  return load(file.path());
}

bool failsAs(ErrorCode code, const Result<Field>& result) {
  if (result.ok()) return false;
  const std::string& text = result.error().text;
  return result.error().code == code && !text.empty() && text.find('\n') == std::string::npos;
}

/// The library's checksum, so that a test can forge one.
std::uint64_t fnv1a(const char* begin, const char* end) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (; begin != end; ++begin) hash = (hash ^ std::uint8_t(*begin)) * 0x100000001b3ull;
  return hash;
}

constexpr std::size_t kVersionAt = 8, kSizeAt = 12, kChecksumAt = 20, kPayloadAt = 28;

/// Bytes whose checksum is right again.
Bytes forged(Bytes bytes) {
  const std::uint64_t sum = fnv1a(bytes.data() + kPayloadAt, bytes.data() + bytes.size());
  std::memcpy(bytes.data() + kChecksumAt, &sum, sizeof sum);
  return bytes;
}

}  // namespace

TEST_CASE("Saved, loaded and saved again is the same file, and the same guide") {
  std::vector<FieldSettings> all = mixtureSettings();
  for (FieldSettings settings : all) {
    settings.maxMemoryBytes = 123'456'789;
    settings.sTreeThreshold = 700;
    Field field = train(settings, coneRadiance, 3, 5'000);
    Random random(1);
    REQUIRE(field.accumulate(record(field, coneRadiance, 1'000, random)));  // in the middle of an iteration
    const Bytes bytes = bytesOf(field);
    Result<Field> loaded = loadBytes(bytes);
    REQUIRE(loaded.ok());
    Field& copy = loaded.value();
    CHECK(bytesOf(copy) == bytes);
    CHECK(copy.validate());
    CHECK(copy.hasGuide());
    CHECK(copy.bounds() == field.bounds());
    CHECK(copy.stats().samples == field.stats().samples);
    CHECK(copy.stats().quadtreeNodes == field.stats().quadtreeNodes);
    CHECK(copy.settings().maxMemoryBytes == 123'456'789);
    for (int i = 0; i < 1000; ++i) {
      const Imath::V3f p = uniformPosition(random);
      const Imath::V2f u = random.next2D();
      if (copy.bind(p).sample(u).wi != field.bind(p).sample(u).wi) FAIL("another guide");
    }
    // Learning goes on alike.
    REQUIRE(field.endIteration(4));
    REQUIRE(copy.endIteration(4));
    CHECK(bytesOf(copy) == bytesOf(field));
  }
}

TEST_CASE("Fields at their extremes survive the way through a file") {
  FieldSettings settings = FieldSettings::mueller2017();
  const Field fresh = makeField(settings, Imath::Box3f({-1e30f, 0, 1}, {1e30f, 0, 1}));
  CHECK(loadBytes(bytesOf(fresh)).ok());

  Field spike = makeField(settings);  // one direction: a single cell at full depth
  for (int i = 0; i < 12; ++i) {
    SampleBuffer buffer;
    buffer.add({{0.5f, 0.5f, 0.5f}, Imath::V3f(0.3f, 0.5f, 0.8f).normalized(), 1, 1, 1, 1, 0, 1});
    REQUIRE(spike.accumulate(buffer));
    REQUIRE(spike.endIteration(4));
  }
  CHECK(spike.stats().maxQuadtreeDepth == 20);
  CHECK(spike.validate());
  CHECK(loadBytes(bytesOf(spike)).ok());
}

TEST_CASE("A truncated file is refused, wherever it ends") {
  const Bytes bytes = bytesOf(smallField());
  REQUIRE(bytes.size() > 2'000);
  int accepted = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    accepted += !failsAs(ErrorCode::Format, loadBytes(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size))));
  CHECK(accepted == 0);
  Bytes longer = bytes;
  longer.push_back(0);
  CHECK(failsAs(ErrorCode::Format, loadBytes(longer)));
}

TEST_CASE("A flipped bit is noticed, wherever it is") {
  const Bytes bytes = bytesOf(smallField());
  int accepted = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    Bytes flipped = bytes;
    flipped[at] = char(flipped[at] ^ (1 << (at % 8)));
    accepted += !failsAs(ErrorCode::Format, loadBytes(flipped));
  }
  CHECK(accepted == 0);
}

// Damage behind a right checksum is the work of somebody: what loads must still be a field that does not crash.
TEST_CASE("Forged bytes give an error or a sound field") {
  const Bytes bytes = bytesOf(smallField());
  Random random(2);
  int refused = 0, loaded = 0;
  for (std::size_t at = kPayloadAt; at < bytes.size(); ++at)
    for (const int value : {0, 0x7f, 0x80, 0xff}) {
      Bytes forgery = bytes;
      forgery[at] = char(value);
      Result<Field> result = loadBytes(forged(forgery));
      if (!result) {
        refused += result.error().code == ErrorCode::Format;
        continue;
      }
      ++loaded;
      Field& field = result.value();
      if (!field.validate()) FAIL("byte " << at);
      for (int i = 0; i < 20; ++i) {
        const GuidingDistribution guide = field.bind(uniformPosition(random) * 3.0f - Imath::V3f(1));
        if (!guide) continue;
        const DirectionSample s = guide.sample(random.next2D());
        if (!(s.pdf >= 0) || s.pdf != guide.pdf(s.wi)) FAIL("byte " << at << ": pdf " << s.pdf);
      }
      field.stats();
    }
  CHECK(refused > 1000);
  CHECK(loaded > 1000);
}

TEST_CASE("Forged counts are refused before anything is allocated") {
  const Bytes bytes = bytesOf(smallField());
  for (const std::uint64_t huge : {std::uint64_t(1) << 32, std::uint64_t(1) << 60, ~std::uint64_t(0)}) {
    for (std::size_t at = kPayloadAt; at + 8 <= bytes.size(); at = at < 300 ? at + 1 : at + 8) {
      Bytes forgery = bytes;
      std::memcpy(forgery.data() + at, &huge, 8);
      const Result<Field> result = loadBytes(forged(forgery));  // would run out of memory if it believed
      if (!result) REQUIRE(result.error().code == ErrorCode::Format);
    }
    Bytes claims = bytes;
    std::memcpy(claims.data() + kSizeAt, &huge, 8);
    CHECK(failsAs(ErrorCode::Format, loadBytes(claims)));
  }
}

namespace {

constexpr std::uint64_t kCount = 12'347;

/// A field of one leaf that learned kCount records, which its file says are more: in its leaf, and in all.
Bytes claimingRecords(double sTreeThreshold, std::uint64_t ofLeaf, std::uint64_t ofField) {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = sTreeThreshold;
  settings.maxMemoryBytes = 10'000'000;
  Field field = makeField(settings);
  Random random(5);
  REQUIRE(field.accumulate(record(field, coneRadiance, int(kCount), random)));
  Bytes bytes = bytesOf(field);
  std::vector<std::uint64_t> claims{ofLeaf, ofField};  // in the file the field's count comes first
  for (std::size_t at = kPayloadAt; at + 8 <= bytes.size() && !claims.empty(); ++at)
    if (std::memcmp(bytes.data() + at, &kCount, 8) == 0) {
      std::memcpy(bytes.data() + at, &claims.back(), 8);
      claims.pop_back();
    }
  REQUIRE(claims.empty());
  return forged(bytes);
}

}  // namespace

TEST_CASE("A leaf that counts 2^32 records is split as its count says") {
  constexpr std::uint64_t kMany = (std::uint64_t(1) << 32) + 7;
  Result<Field> loaded = loadBytes(claimingRecords(double(1 << 28), kMany, kMany));
  REQUIRE(loaded.ok());
  Field& full = loaded.value();
  Random random(6);
  CHECK(full.stats().samples == kMany);
  REQUIRE(full.accumulate(record(full, coneRadiance, 1, random)));
  CHECK(full.stats().samples == kMany + 1);
  REQUIRE(full.endIteration(2));  // the threshold is 2^28: 16 leaves hold 2^28 and a half, 32 hold less
  CHECK(full.stats().spatialLeaves == 32);
  CHECK(full.validate());
}

TEST_CASE("A leaf that counts 2^62 records is split as far as the cap on memory allows") {
  constexpr std::uint64_t kMost = std::uint64_t(1) << 62;
  Result<Field> loaded = loadBytes(claimingRecords(1, kMost, kMost));
  REQUIRE(loaded.ok());
  REQUIRE(loaded.value().endIteration(4));
  CHECK(loaded.value().stats().memoryCapReached);
  CHECK(loaded.value().stats().spatialLeaves > 1000);
  CHECK(loaded.value().stats().memoryBytes < 20'000'000);
  CHECK(loaded.value().validate());
}

TEST_CASE("Leaves that count more records than their field are refused") {
  CHECK(failsAs(ErrorCode::Format, loadBytes(claimingRecords(1000, kCount + 1, kCount))));
  CHECK(failsAs(ErrorCode::Format, loadBytes(claimingRecords(1000, ~std::uint64_t(0), kCount))));
  CHECK(loadBytes(claimingRecords(1000, kCount, kCount + 1)).ok());
}

TEST_CASE("Foreign files are told apart") {
  CHECK(failsAs(ErrorCode::Format, loadBytes({})));
  CHECK(failsAs(ErrorCode::Format, loadBytes({'h', 'e', 'l', 'l', 'o'})));
  CHECK(failsAs(ErrorCode::Format, loadBytes(Bytes(10'000, 'x'))));
  Bytes newer = bytesOf(smallField());
  ++newer[kVersionAt];
  const Result<Field> result = loadBytes(newer);
  REQUIRE(failsAs(ErrorCode::Format, result));
  CHECK_THAT(result.error().text, Catch::Contains("version"));
}

TEST_CASE("A limit of memory holds for a forged file and for what learning makes of it") {
  FieldSettings settings = FieldSettings::mueller2017();
  settings.sTreeThreshold = 1;
  Field field = makeField(settings);
  Random random(1);
  REQUIRE(field.accumulate(record(field, coneRadiance, 1'000, random)));
  Bytes bytes = bytesOf(field);
  // The counts of all samples and of those in the only leaf claim 2^62.
  const std::uint64_t honest = 1'000, claimed = std::uint64_t(1) << 62;
  int forgeries = 0;
  for (std::size_t i = kPayloadAt; i + sizeof honest <= bytes.size() && forgeries < 2; ++i)
    if (std::memcmp(bytes.data() + i, &honest, sizeof honest) == 0) {
      std::memcpy(bytes.data() + i, &claimed, sizeof claimed);
      ++forgeries;
    }
  REQUIRE(forgeries == 2);
  const TemporaryFile file("forged.field");
  writeBytes(file.path(), forged(bytes));

  constexpr std::size_t kLimit = 1 << 20;
  Result<Field> loaded = load(file.path(), kLimit);
  REQUIRE(loaded.ok());
  CHECK(loaded.value().settings().maxMemoryBytes == kLimit);
  REQUIRE(loaded.value().endIteration(4));
  CHECK(loaded.value().stats().spatialLeaves > 1);
  CHECK(loaded.value().stats().memoryBytes < kLimit);
  CHECK(loaded.value().stats().memoryCapReached);
  CHECK(loaded.value().validate());

  const Result<Field> refused = load(file.path(), 100);
  REQUIRE(failsAs(ErrorCode::OutOfMemory, refused));
  CHECK_THAT(refused.error().text, Catch::Contains("limit of 100"));
  CHECK(load(file.path()).value().settings().maxMemoryBytes == 0);
}

TEST_CASE("A sparse file of a terabyte is not read before it is known to be a field") {
  const TemporaryFile file("huge.field");
  writeBytes(file.path(), Bytes(100, 'x'));
  std::error_code failed;
  fs::resize_file(file.path(), std::uintmax_t(1) << 40, failed);
  if (failed) {
    WARN("skipped: this file system has no sparse files (" << failed.message() << ")");
    return;
  }
  CHECK(failsAs(ErrorCode::Format, load(file.path())));
}

TEST_CASE("Paths that cannot be read or written give the path and the reason") {
  const Field field = smallField();
  for (const char* path : {"no/such/folder/a.field", ".", ""}) {
    CAPTURE(path);
    const Status saved = save(field, path);
    REQUIRE(!saved);
    CHECK(saved.error().code == ErrorCode::Io);
    const Result<Field> loaded = load(path);
    REQUIRE(!loaded);
    CHECK(loaded.error().code == ErrorCode::Io);
    CHECK_THAT(loaded.error().text, Catch::Contains(path));
  }
  CHECK(!fs::exists("no"));
}

TEST_CASE("A failed save keeps the old file and leaves nothing behind") {
  const fs::path folder = "save_into_this";
  fs::remove_all(folder);
  fs::create_directory(folder);
  const Field field = smallField();
  REQUIRE(save(field, folder / "a.field"));
  const Bytes before = readBytes(folder / "a.field");
  REQUIRE(save(smallField(FieldSettings::mueller2017()), folder / "a.field"));
  CHECK(readBytes(folder / "a.field") != before);

  fs::create_directory(folder / "taken");  // a folder stands where the file should go
  const Status status = save(field, folder / "taken");
  REQUIRE(!status);
  CHECK_THAT(status.error().text, Catch::Contains("taken"));
  int entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++entries;
  CHECK(entries == 2);
  fs::remove_all(folder);
}

TEST_CASE("The rests of a killed run are not in the way") {
  const Field field = smallField();
  const TemporaryFile file("with_rests.field"), rest("with_rests.field.tmp0");
  writeBytes(rest.path(), {'x'});
  REQUIRE(save(field, file.path()));
  CHECK(load(file.path()).ok());
  CHECK(readBytes(rest.path()) == Bytes{'x'});
}
