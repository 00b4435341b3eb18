// One service at a time holds a catalogue.
#ifndef PLENUM_SERVER_JOBS_CATALOGUE_HOLD_H_
#define PLENUM_SERVER_JOBS_CATALOGUE_HOLD_H_

#include <filesystem>

namespace plenum::server {

// While it lives, no other service holds the file, under whatever name: a link leads to the same
// file. It must outlive every connection of this process to the catalogue, whose locks its end
// would take away (fcntl(2)).
class CatalogueHold {
 public:
  // Throws catalog::StoreError (kBusy) where another service holds the file. One that cannot be
  // opened is not held: opening the catalogue tells why. Services share a server.
  explicit CatalogueHold(const std::filesystem::path& catalogue);
  ~CatalogueHold();
  CatalogueHold(const CatalogueHold&) = delete;
  CatalogueHold& operator=(const CatalogueHold&) = delete;

 private:
  int file_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_CATALOGUE_HOLD_H_
