#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene_description.h"
#include "textures/texture.h"

namespace pt {

/// Which texels of which file; textures that ask for the same share them.
struct PictureKey {
  std::filesystem::path file;
  std::shared_ptr<const std::string> bytes;  ///< of the file, if they are at hand
  TextureEncoding encoding = TextureEncoding::Srgb;
  TextureChannel channel = TextureChannel::Color;
  bool mipMapped = false;

  auto operator<=>(const PictureKey&) const = default;
};

/// A picture file whose header was read.
class PictureFile {
 public:
  /// Throws InputError, naming the file, if it cannot be read or lacks the channel.
  explicit PictureFile(const PictureKey& key);

  const PictureKey& key() const { return m_key; }
  /// Whether it can be opened again by its name.
  bool isFile() const { return m_key.bytes == nullptr; }
  int width() const { return m_spec.width; }
  int height() const { return m_spec.height; }
  int firstChannel() const { return m_firstChannel; }
  int channels() const { return m_channels; }  ///< 1 or 3
  bool isBytes() const { return m_spec.format == OIIO::TypeDesc::UINT8; }
  bool isHalf() const { return m_spec.format == OIIO::TypeDesc::HALF; }
  /// Whether the numbers in the file are sRGB-encoded.
  bool isSrgb() const;

  /// Of all levels, held in memory.
  std::size_t memoryBytes() const;

  /// All texels, channels() values each, as they stand in the file. Throws InputError.
  template <class T>
  std::vector<T> read() const {
    std::vector<T> values(std::size_t(width()) * std::size_t(height()) * std::size_t(m_channels));
    readAs(OIIO::BaseTypeFromC<T>::value, values.data());
    return values;
  }

 private:
  struct Reader {
    std::unique_ptr<OIIO::Filesystem::IOProxy> bytes;  ///< read by `input`
    std::unique_ptr<OIIO::ImageInput> input;
  };

  Reader open() const;
  void requireWhole() const;
  void readAs(OIIO::TypeDesc type, void* values) const;
  void chooseChannels();
  [[noreturn]] void fail(std::string reason) const;

  PictureKey m_key;
  Reader m_reader;
  OIIO::ImageSpec m_spec;
  int m_firstChannel = 0, m_channels = 3;
};

}  // namespace pt
