#include "textures/picture.h"

#include <fmt/format.h>

#include "core/error.h"

namespace pt {

namespace {

/// A name whose ending tells the format.
std::string nameByContent(const std::string& bytes) {
  return bytes.starts_with("\x89PNG") ? "embedded.png" : bytes.starts_with("\xff\xd8") ? "embedded.jpg" : "embedded";
}

}  // namespace

PictureFile::PictureFile(const PictureKey& key) : m_key(key) {
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // colours as they were painted
  if (key.bytes) {
    m_bytes = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<char*>(key.bytes->data()), key.bytes->size());
    void* const proxy = m_bytes.get();
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  }
  m_input = OIIO::ImageInput::open(key.bytes ? nameByContent(*key.bytes) : key.file.string(), &config);
  if (!m_input) {
    std::string reason = OIIO::geterror();
    reason.erase(std::find(reason.begin(), reason.end(), '\n'), reason.end());
    throw InputError(fmt::format("{}: cannot be read as a picture: {}", key.file.string(), reason));
  }
  m_spec = m_input->spec();
  if (m_spec.width < 1 || m_spec.height < 1 || m_spec.nchannels < 1 || m_spec.depth > 1)
    throw InputError(key.file.string() + ": is no picture of rows and columns");
  chooseChannels();
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
  if (!m_input->read_image(0, 0, m_firstChannel, m_firstChannel + m_channels, type, values))
    throw InputError(fmt::format("{}: the picture is damaged: {}", m_key.file.string(), m_input->geterror()));
}

}  // namespace pt
