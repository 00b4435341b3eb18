#include "catalog/store/place.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include "catalog/store/backup.h"
#include "catalog/store/store_error.h"

namespace plenum::catalog {
namespace {

namespace fs = std::filesystem;

constexpr char kFile[] = "catalog.db";

// False also where a folder on the way cannot be read.
bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// Empty without the variable.
fs::path Variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

fs::path Program() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

// The program of a checkout stands in its build/PRESET/.
fs::path CheckoutCatalog() {
  const fs::path build = Program().parent_path().parent_path();
  return build.filename() == "build" ? build.parent_path() / kFile : fs::path();
}

fs::path Home() {
  if (fs::path home = Variable("HOME"); !home.empty()) return home;
  const passwd* user = getpwuid(geteuid());
  return user != nullptr ? user->pw_dir : "/";
}

// Takes the name `path` for the copy, unless another process was faster.
void TakeName(const fs::path& copy, const fs::path& path) {
  std::error_code error, ignored;
  fs::create_hard_link(copy, path, error);
  if (error && !Exists(path)) fs::rename(copy, path, ignored);  // a file system without links
  fs::remove(copy, ignored);
}

}  // namespace

fs::path InstalledSeed() {
  fs::path beside = Program().parent_path().parent_path() / "share" / "plenum" / kFile;
  if (Exists(beside)) return beside;
  const fs::path installed = fs::path("/usr/share/plenum") / kFile;
  return Exists(installed) ? installed : fs::path();
}

fs::path UserCatalog() {
  fs::path data = Variable("XDG_DATA_HOME");
  if (!data.is_absolute()) data = Home() / ".local" / "share";
  return data / "plenum" / kFile;
}

fs::path DefaultCatalog(const fs::path& seed) {
  if (fs::path named = Variable("PLENUM_CATALOG"); !named.empty()) return named;
  if (Exists(kFile)) return kFile;
  if (fs::path checkout = CheckoutCatalog(); Exists(checkout)) return checkout;
  const fs::path users = UserCatalog();
  return Exists(users) || !seed.empty() ? users : fs::path(kFile);
}

fs::path BeginCatalog(const fs::path& path, const fs::path& seed) {
  if (Exists(path) || seed.empty() || path != UserCatalog()) return path;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const fs::path copy = path.string() + ".seed-" + std::to_string(getpid());
  try {
    Backup(seed, copy);
  } catch (const StoreError& fault) {
    if (fault.fault() != StoreFault::kStorage) throw;
    return seed;
  }
  TakeName(copy, path);
  return Exists(path) ? path : seed;
}

}  // namespace plenum::catalog
