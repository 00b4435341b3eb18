#include "tests/support/places.h"

namespace plenum::test {

std::filesystem::path SourceDir() { return PLENUM_SOURCE_DIR; }

}  // namespace plenum::test
