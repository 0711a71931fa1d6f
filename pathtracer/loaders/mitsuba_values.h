#pragma once

#include <optional>

#include "loaders/mitsuba_object.h"

namespace pt::mitsuba {

/// True for <float>, <rgb>, <transform>, ...: elements that give a property.
bool isValueTag(const std::string& tag);

/// Names of all value tags.
const std::vector<std::string>& valueTags();

/// The value that such an element gives. Throws InputError.
Value readValue(const Element& element);

/// Throws unless all attributes are among `known`.
void checkAttributes(const Element& element, const std::vector<std::string>& known);

}  // namespace pt::mitsuba
