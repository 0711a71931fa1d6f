#include "loaders/gltf_accessors.h"

#include <fmt/format.h>

namespace pt::gltf {
namespace {

constexpr int kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;  // unsigned but for the last

std::uint64_t componentBytes(const json::Node& node, const std::string& type) {
  const int kind = node.integer(0);
  if (type != "SCALAR") {
    if (kind != kFloat) node.fail("only floats are supported here; export the file without quantization");
    return 4;
  }
  if (kind != kByte && kind != kShort && kind != kInt)
    node.fail("indices must be unsigned integers: 5121, 5123 or 5125");
  return kind == kByte ? 1 : kind == kShort ? 2 : 4;
}

std::uint64_t sizeAt(json::ObjectReader& reader, const char* key) {
  return std::uint64_t(reader.integer(key, 0, 0));
}

/// Throws InputError unless `end` bytes fit into the view, and the view into its buffer.
void checkView(const Document& document, const json::Node& index, std::uint64_t end, std::uint64_t& stride) {
  json::ObjectReader view(elementOf(document, "bufferViews", index));
  const auto length = std::uint64_t(view.require("byteLength").integer(0));
  if (stride < sizeAt(view, "byteStride")) stride = sizeAt(view, "byteStride");
  json::ObjectReader buffer(elementOf(document, "buffers", view.require("buffer")));
  const auto bufferLength = std::uint64_t(buffer.require("byteLength").integer(0));
  if (sizeAt(view, "byteOffset") + length > bufferLength)
    view.node().fail(fmt::format("does not fit into its buffer of {} bytes", bufferLength));
  if (!buffer.find("uri") && bufferLength > document.binary.size())
    buffer.node().fail(fmt::format("announces {} bytes where the file has {}", bufferLength, document.binary.size()));
  if (end > length) index.fail(fmt::format("refers to {} bytes, of which the view has {}", end, length));
}

}  // namespace

void checkAccessor(const Document& document, const json::Node& index, const std::string& type) {
  json::ObjectReader accessor(elementOf(document, "accessors", index));
  const json::Node kind = accessor.require("type");
  if (kind.string() != type) kind.fail(fmt::format("must be {} for {}", type, index.source()));
  const std::uint64_t components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : 3;
  const std::uint64_t size = components * componentBytes(accessor.require("componentType"), type);
  const auto count = std::uint64_t(accessor.require("count").integer(1));
  if (accessor.find("sparse")) accessor.require("sparse").fail("sparse accessors are not supported");
  std::uint64_t stride = size;
  const json::Node view = accessor.require("bufferView");
  checkView(document, view, 0, stride);
  checkView(document, view, sizeAt(accessor, "byteOffset") + stride * (count - 1) + size, stride);
}

}  // namespace pt::gltf
