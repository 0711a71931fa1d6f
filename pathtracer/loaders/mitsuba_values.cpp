#include "loaders/mitsuba_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/near_name.h"
#include "loaders/color.h"
#include "loaders/loader_error.h"
#include "loaders/parse_number.h"

namespace pt::mitsuba {
namespace {

const std::string* findAttribute(const Element& element, const std::string& name) {
  const auto found = element.attributes.find(name);
  return found == element.attributes.end() ? nullptr : &found->second;
}

const std::string& attribute(const Element& element, const std::string& name) {
  if (const std::string* value = findAttribute(element, name)) return *value;
  failAt(element.source, fmt::format("<{}> lacks the attribute '{}'", element.tag, name));
}

[[noreturn]] void failValue(const Element& element, std::string_view text, const std::string& wanted) {
  failAt(element.source, fmt::format("<{}>: '{}' is not {}", element.tag, text, wanted));
}

double toNumber(const Element& element, std::string_view text) {
  if (const auto number = parseNumber(text)) return *number;
  failValue(element, text, "a finite number");
}

double numberAttribute(const Element& element, const std::string& name, double fallback) {
  const std::string* text = findAttribute(element, name);
  return text ? toNumber(element, *text) : fallback;
}

std::vector<double> toNumbers(const Element& element, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string_view piece : splitList(text)) numbers.push_back(toNumber(element, piece));
  return numbers;
}

Vec3d toVector(const Element& element, const std::string& text) {
  const auto numbers = toNumbers(element, text);
  if (numbers.size() != 3) failValue(element, text, "three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

/// From x, y, z, or from value="x, y, z".
Vec3d vectorOf(const Element& element, double missing) {
  if (const std::string* value = findAttribute(element, "value")) {
    checkAttributes(element, {"name", "value", "angle"});
    return toVector(element, *value);
  }
  return {numberAttribute(element, "x", missing), numberAttribute(element, "y", missing),
          numberAttribute(element, "z", missing)};
}

// ---------------------------------------------------------------- plain values

bool readBoolean(const Element& element) {
  const std::string& text = attribute(element, "value");
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  failValue(element, text, "true or false");
}

std::int64_t readInteger(const Element& element) {
  const std::string& text = attribute(element, "value");
  if (const auto integer = parseInteger(text)) return *integer;
  failValue(element, text, "an integer");
}

// ---------------------------------------------------------------- colours

Spectrum readRgb(const Element& element) {
  const std::string& text = attribute(element, "value");
  if (const auto hex = parseHexColor(text)) return *hex;
  const auto numbers = toNumbers(element, text);
  if (numbers.size() == 1) return Spectrum(static_cast<float>(numbers[0]));
  if (numbers.size() != 3) failValue(element, text, "a colour: one number, three numbers or #rrggbb");
  return Spectrum(Vec3(Vec3d(numbers[0], numbers[1], numbers[2])));
}

Spectrum readSpectrum(const Element& element) {
  if (findAttribute(element, "filename"))
    throw UnsupportedError(element.source, "a spectrum read from a file is not supported");
  const std::string& text = attribute(element, "value");
  std::vector<SpectralSample> samples;
  for (const std::string_view piece : splitList(text)) {
    const std::size_t colon = piece.find(':');
    if (colon == std::string_view::npos) {
      if (splitList(text).size() != 1) failValue(element, text, "one number or a list of wavelength:value");
      return Spectrum(static_cast<float>(toNumber(element, piece)));
    }
    samples.push_back({toNumber(element, piece.substr(0, colon)), toNumber(element, piece.substr(colon + 1))});
  }
  const auto notRising = [](const SpectralSample& a, const SpectralSample& b) { return a.nanometers >= b.nanometers; };
  if (samples.empty() || std::adjacent_find(samples.begin(), samples.end(), notRising) != samples.end())
    failValue(element, text, "a list of wavelength:value in order of rising wavelength");
  return spectrumToRgb(samples);
}

Spectrum readBlackbody(const Element& element) {
  std::string text = attribute(element, "temperature");
  if (!text.empty() && (text.back() == 'K' || text.back() == 'k')) text.pop_back();
  const double kelvin = toNumber(element, text);
  if (!(kelvin > 0)) failValue(element, text, "a temperature above 0 K");
  return blackbodyToRgb(kelvin) * static_cast<float>(numberAttribute(element, "scale", 1));
}

// ---------------------------------------------------------------- transforms

Transform readRotate(const Element& element) {
  checkAttributes(element, {"x", "y", "z", "value", "angle"});
  const auto turned = rotation(vectorOf(element, 0), toNumber(element, attribute(element, "angle")));
  if (!turned) failAt(element.source, "<rotate>: the axis has no length");
  return *turned;
}

Transform readScale(const Element& element) {
  checkAttributes(element, {"x", "y", "z", "value"});
  const std::string* value = findAttribute(element, "value");
  if (value && splitList(*value).size() == 1) return scaling(Vec3d(toNumber(element, *value)));
  return scaling(vectorOf(element, 1));
}

Transform readTranslate(const Element& element) {
  checkAttributes(element, {"x", "y", "z", "value"});
  return translation(vectorOf(element, 0));
}

Transform readLookAt(const Element& element) {
  checkAttributes(element, {"origin", "target", "up"});
  const std::string* up = findAttribute(element, "up");
  const auto view = lookAt(toVector(element, attribute(element, "origin")),
                           toVector(element, attribute(element, "target")), up ? toVector(element, *up) : Vec3d(0.0));
  if (!view)
    failAt(element.source, fmt::format("<{}>: origin and target coincide, or 'up' points along the view", element.tag));
  return *view;
}

Transform readMatrix(const Element& element) {
  checkAttributes(element, {"value"});
  const std::string& text = attribute(element, "value");
  const auto numbers = toNumbers(element, text);
  double rows[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  if (numbers.size() == 16) {
    std::copy(numbers.begin(), numbers.end(), rows);
  } else if (numbers.size() == 9) {
    for (int i = 0; i < 9; ++i) rows[4 * (i / 3) + i % 3] = numbers[i];
  } else {
    failAt(element.source, fmt::format("<matrix> holds {} numbers; it takes 16 (or 9)", numbers.size()));
  }
  return fromColumnVectorMatrix(rows);
}

Transform readTransform(const Element& element) {
  static const std::map<std::string, std::function<Transform(const Element&)>> kSteps = {
      {"translate", readTranslate}, {"rotate", readRotate}, {"scale", readScale},
      {"lookat", readLookAt},       {"lookAt", readLookAt}, {"matrix", readMatrix}};
  Transform total;
  for (const Element& step : element.children) {
    const auto reader = kSteps.find(step.tag);
    if (reader == kSteps.end())
      failAt(step.source, fmt::format("<transform> takes no <{}>{}", step.tag,
                                      suggestName(step.tag, {"translate", "rotate", "scale", "lookat", "matrix"})));
    total = total * reader->second(step);
  }
  return total;
}

// ---------------------------------------------------------------- all of them

struct ValueReader {
  std::vector<std::string> attributes;
  std::function<Value(const Element&)> read;
};

const std::map<std::string, ValueReader>& valueReaders() {
  static const std::map<std::string, ValueReader> kReaders = {
      {"boolean", {{"name", "value"}, readBoolean}},
      {"integer", {{"name", "value"}, readInteger}},
      {"float", {{"name", "value"}, [](const Element& e) { return toNumber(e, attribute(e, "value")); }}},
      {"string", {{"name", "value"}, [](const Element& e) { return attribute(e, "value"); }}},
      {"point", {{"name", "value", "x", "y", "z"}, [](const Element& e) { return vectorOf(e, 0); }}},
      {"vector", {{"name", "value", "x", "y", "z"}, [](const Element& e) { return vectorOf(e, 0); }}},
      {"rgb", {{"name", "value"}, readRgb}},
      {"srgb", {{"name", "value"}, [](const Element& e) { return srgbToLinear(readRgb(e)); }}},
      {"spectrum", {{"name", "value", "filename"}, readSpectrum}},
      {"blackbody", {{"name", "temperature", "scale"}, readBlackbody}},
      {"transform", {{"name"}, readTransform}},
  };
  return kReaders;
}

}  // namespace

bool isValueTag(const std::string& tag) {
  return valueReaders().contains(tag);
}

const std::vector<std::string>& valueTags() {
  static const std::vector<std::string> kTags = [] {
    std::vector<std::string> tags;
    for (const auto& [tag, reader] : valueReaders()) tags.push_back(tag);
    return tags;
  }();
  return kTags;
}

void checkAttributes(const Element& element, const std::vector<std::string>& known) {
  for (const auto& [name, value] : element.attributes)
    if (std::find(known.begin(), known.end(), name) == known.end())
      failAt(element.source, fmt::format("<{}> has no attribute '{}'{}", element.tag, name, suggestName(name, known)));
}

Value readValue(const Element& element) {
  const ValueReader& reader = valueReaders().at(element.tag);
  checkAttributes(element, reader.attributes);
  if (element.tag != "transform" && !element.children.empty())
    failAt(element.source, fmt::format("<{}> cannot hold other elements", element.tag));
  return reader.read(element);
}

}  // namespace pt::mitsuba
