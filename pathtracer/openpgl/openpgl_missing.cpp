#include "core/error.h"
#include "openpgl/openpgl_field.h"

namespace pt {

bool hasOpenPgl() noexcept {
  return false;
}

std::unique_ptr<OpenPglField> createOpenPglField(const Imath::Box3f&, const OpenPglSettings&) {
  throw InputError(kNoOpenPgl);
}

}  // namespace pt
