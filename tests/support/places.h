// Where the project's own files are.
#ifndef PLENUM_TESTS_SUPPORT_PLACES_H_
#define PLENUM_TESTS_SUPPORT_PLACES_H_

#include <filesystem>

namespace plenum::test {

std::filesystem::path SourceDir();  // the top of the checkout

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PLACES_H_
