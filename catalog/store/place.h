// Which catalogue a program opens that is told none, and how a user's own one begins.
#ifndef PLENUM_CATALOG_STORE_PLACE_H_
#define PLENUM_CATALOG_STORE_PLACE_H_

#include <filesystem>

namespace plenum::catalog {

// The catalogue that was installed with this program, which nobody writes: share/plenum/catalog.db
// beside the folder of the program, else below /usr. Empty where there is none.
std::filesystem::path InstalledSeed();

// The first of these that there is: what PLENUM_CATALOG names; catalog.db in the current folder;
// that of the checkout where the program was built; that of the user, which `seed` may begin.
// Without any: catalog.db. Only looks.
std::filesystem::path DefaultCatalog(const std::filesystem::path& seed = InstalledSeed());

// plenum/catalog.db in the folder for data of the user (XDG Base Directory Specification:
// XDG_DATA_HOME, else ~/.local/share).
std::filesystem::path UserCatalog();

// Makes the user's catalogue a copy of the seed, if `path` is the user's catalogue and missing.
// Gives where to read: the seed itself where the copy cannot be made, else `path`. Throws
// StoreError where the seed is damaged.
std::filesystem::path BeginCatalog(const std::filesystem::path& path,
                                   const std::filesystem::path& seed = InstalledSeed());

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_PLACE_H_
