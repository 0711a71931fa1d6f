#include "textures/picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "film/picture_checks.h"

namespace pt {

namespace {

/// A name whose ending tells the format.
std::string nameByContent(const std::string& bytes) {
  return bytes.starts_with("\x89PNG") ? "embedded.png" : bytes.starts_with("\xff\xd8") ? "embedded.jpg" : "embedded";
}

}  // namespace

PictureFile::PictureFile(const PictureKey& key) : m_key(key) {
  if (const auto fault = key.bytes ? faultOfPictureBytes(*key.bytes) : faultOfPictureFile(key.file)) fail(*fault);
  m_reader = open();
  m_spec = m_reader.input->spec();
  constexpr std::int64_t kMostOfFile = std::int64_t(kMaxFilmSize) * kMaxFilmSize;  // in tiles, if memory is short
  if (const auto fault = faultOfPictureSize(m_spec, isFile() ? kMostOfFile : kMaxFilmPixels)) fail(*fault);
  requireWhole();
  chooseChannels();
}

PictureFile::Reader PictureFile::open() const {
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // colours as they were painted
  Reader reader;
  if (m_key.bytes) {
    reader.bytes =
        std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<char*>(m_key.bytes->data()), m_key.bytes->size());
    void* const proxy = reader.bytes.get();
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  }
  reader.input = OIIO::ImageInput::open(m_key.bytes ? nameByContent(*m_key.bytes) : m_key.file.string(), &config);
  if (!reader.input) fail(OIIO::geterror());
  return reader;
}

/// By a reader of its own: one that went back to the start would forget how it was opened.
void PictureFile::requireWhole() const {
  std::error_code ignored;
  const std::uintmax_t size = m_key.bytes ? m_key.bytes->size() : std::filesystem::file_size(m_key.file, ignored);
  if (!announcesMuch(m_spec, size)) return;
  const Reader probe = open();
  if (!hasLastPixel(*probe.input)) fail(probe.input->geterror());
}

void PictureFile::fail(std::string reason) const {
  reason.erase(std::find(reason.begin(), reason.end(), '\n'), reason.end());
  throw InputError(fmt::format("{}: cannot be read as a picture: {}", m_key.file.string(), reason));
}

void PictureFile::chooseChannels() {
  const int alpha = m_spec.alpha_channel;
  const bool isGray = m_spec.nchannels - (alpha >= 0 ? 1 : 0) < 3;
  m_channels = m_key.channel == TextureChannel::Color && !isGray ? 3 : 1;
  switch (m_key.channel) {
    case TextureChannel::Color:
    case TextureChannel::Red:
      m_firstChannel = 0;
      break;
    case TextureChannel::Green:
      m_firstChannel = isGray ? 0 : 1;
      break;
    case TextureChannel::Blue:
      m_firstChannel = isGray ? 0 : 2;
      break;
    case TextureChannel::Alpha:
      if (alpha < 0)
        throw InputError(m_key.file.string() + ": the picture has no alpha channel; name another channel of it");
      m_firstChannel = alpha;
  }
}

bool PictureFile::isSrgb() const {
  const bool isInteger = !m_spec.format.is_floating_point();
  return isInteger && m_key.encoding == TextureEncoding::Srgb && m_key.channel != TextureChannel::Alpha;
}

std::size_t PictureFile::memoryBytes() const {
  const std::size_t texel = std::size_t(m_channels) * (isBytes() ? 1 : isHalf() ? 2 : 4);
  const std::size_t finest = std::size_t(m_spec.width) * std::size_t(m_spec.height) * texel;
  return m_key.mipMapped ? finest + finest / 3 : finest;
}

void PictureFile::readAs(OIIO::TypeDesc type, void* values) const {
  if (!m_reader.input->read_image(0, 0, m_firstChannel, m_firstChannel + m_channels, type, values))
    throw InputError(fmt::format("{}: the picture is damaged: {}", m_key.file.string(), m_reader.input->geterror()));
}

}  // namespace pt
