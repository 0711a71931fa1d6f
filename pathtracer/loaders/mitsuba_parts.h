#pragma once

#include <optional>

#include "loaders/mitsuba_reader.h"

/// One reader per kind of plugin. All throw InputError, and UnsupportedError for a plugin that we do not have.
namespace pt::mitsuba {

/// Index into scene.materials; each object is read once. An unsupported BSDF that may be skipped becomes the one it
/// wraps, or grey.
int readBsdf(Context& context, const Object& object);

/// Absorption coefficient of a homogeneous medium.
Spectrum readAbsorption(Context& context, const Object& medium);

/// A texture times a factor; each object is read once.
SpectrumParameter readTexture(Context& context, const Object& object);

/// Adds the shape (or, for a shapegroup, the group) to the scene.
void readShape(Context& context, const Object& object);

/// Adds a light that is not a shape.
void readEmitter(Context& context, const Object& object);
/// A sun, a sky, or both, as a map.
LightDescription readDaylight(Context& context, Reader& reader);
/// Radiance of an area light.
SpectrumParameter readAreaEmitter(Context& context, const Object& object);

/// Camera, film, filter, sampler.
void readSensor(Context& context, const Object& object);

void readIntegrator(Context& context, const Object& object);

}  // namespace pt::mitsuba
