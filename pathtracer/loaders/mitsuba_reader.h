#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "loaders/load_scene.h"
#include "loaders/loader_error.h"
#include "loaders/mesh_library.h"
#include "loaders/mitsuba_object.h"

namespace pt::mitsuba {

/// What all the readers share while a scene is built.
struct Context {
  const LoadOptions& options;
  double version = 0;  ///< of Mitsuba, from the <scene> element
  FileSearch search;
  MeshLibrary meshes;
  SceneDescription scene;
  std::map<const Object*, int> materials;               ///< read already; kNone while being read
  std::map<const Object*, SpectrumParameter> textures;  ///< read already; without texture while being read
  std::map<const Object*, int> groups;
  int openMaterials = 0;  ///< that are being read, one inside the other

  /// Mitsuba 0.x, whose defaults differ here and there.
  bool isOld() const { return version < 2; }

  /// A part of a thing is not supported: throws, or lists it if the user said to skip such parts.
  void leaveOut(const SourceLocation& source, const std::string& what);
  /// The same for a whole thing, of which a reader complained; `instead` tells what stands in for it.
  void leaveOut(const UnsupportedError& error, const std::string& instead);
};

/// Reads an object's properties and remembers which: finish() refuses what nobody asked for.
class Reader {
 public:
  Reader(Context& context, const Object& object) : m_context(context), m_object(object) {}

  const Object& object() const { return m_object; }
  bool has(const std::string& name);
  /// "bsdf 'diffuse'", for messages.
  std::string title() const { return m_object.tag + " '" + m_object.type + "'"; }
  /// The name in the spelling of the file's version.
  std::string spelled(const std::string& name) const;
  /// Throws InputError about a property that stands in the file.
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;

  bool boolean(const std::string& name, bool fallback);
  int integer(const std::string& name, int fallback);
  float number(const std::string& name, float fallback);
  std::string string(const std::string& name, const std::string& fallback);
  Vec3 point(const std::string& name, const Vec3& fallback);
  Spectrum color(const std::string& name, const Spectrum& fallback);
  /// Constants or textures.
  SpectrumParameter spectrum(const std::string& name, const Spectrum& fallback);
  FloatParameter numberOrTexture(const std::string& name, float fallback);
  Matrix4 transform(const std::string& name);
  /// One of the words, as its index; letter case is free.
  int choice(const std::string& name, const std::vector<std::string>& words, int fallback);
  /// An existing file. Throws if the property is missing.
  std::filesystem::path file(const std::string& name);

  /// Known properties that mean nothing here.
  void ignore(std::initializer_list<const char*> names);

  /// Children with that tag; they count as read.
  std::vector<const Object*> children(const std::string& tag);

  /// Refuses (or lists) properties and children that nobody asked for.
  void finish();

 private:
  const Property* find(const std::string& name);
  /// The object that stands for a property, such as a texture; null if there is none.
  const Object* childNamed(const std::string& name);
  template <class T>
  const T* findAs(const std::string& name, const char* wanted);

  Context& m_context;
  const Object& m_object;
  std::set<std::string> m_asked;
  std::set<std::string> m_askedTags;
};

}  // namespace pt::mitsuba
