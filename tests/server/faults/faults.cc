// A library for LD_PRELOAD that makes calls of the system fail at random places: the program that
// runs under it must live through that (faults_test.py).
//
// PLENUM_FAULTS names a file that both share: while `one_in` is not 0, each call of input and
// output fails with the probability 1 / one_in, and each request for memory 1 / one_in_memory.
// Reads and writes that fail may also do a part of their work.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

struct Control {
  std::atomic<std::uint32_t> one_in, one_in_memory, seed, unused;
  std::atomic<std::uint32_t> input, output, files, synced, accepted, memory;  // faults so far
};

std::atomic<Control*> control = nullptr;

__attribute__((constructor)) void Begin() {
  const char* path = getenv("PLENUM_FAULTS");
  const long file = path == nullptr ? -1 : syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  const long at =
      syscall(SYS_mmap, nullptr, sizeof(Control), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (at > 0) control = reinterpret_cast<Control*>(at);  // NOLINT(performance-no-int-to-ptr)
}

// xorshift, of each thread its own. Nothing here may ask for memory.
__attribute__((tls_model("initial-exec"))) thread_local std::uint32_t state = 0;

std::uint32_t Draw(const Control& of) {
  if (state == 0) {
    const auto thread = static_cast<std::uint32_t>(syscall(SYS_gettid));
    state = (of.seed ^ (thread * 2654435761U)) | 1U;
  }
  state ^= state << 13;
  state ^= state >> 17;
  state ^= state << 5;
  return state;
}

bool Fails(std::atomic<std::uint32_t> Control::*counter, bool memory = false) {
  Control* const of = control;
  if (of == nullptr) return false;
  const std::uint32_t one_in = memory ? of->one_in_memory : of->one_in;
  if (one_in == 0 || Draw(*of) % one_in != 0) return false;
  ++(of->*counter);
  return true;
}

template <std::size_t N>
int Fail(const int (&errors)[N]) {
  errno = errors[Draw(*control) % N];
  return -1;
}

// A part of the work, at least a byte, or none of it.
bool OnlyPart(std::size_t& size) {
  if (size < 2 || Draw(*control) % 2 == 0) return false;
  size = 1 + Draw(*control) % (size - 1);
  return true;
}

constexpr int kReadErrors[] = {EIO, EINTR, ENOMEM};
constexpr int kWriteErrors[] = {EIO, ENOSPC, EINTR, ENOMEM};
constexpr int kSocketErrors[] = {ECONNRESET, ENOMEM, EINTR, ENOBUFS};
constexpr int kOpenErrors[] = {EMFILE, ENFILE, ENOMEM, EIO, ENOSPC};
constexpr int kSyncErrors[] = {EIO, ENOSPC};
constexpr int kAcceptErrors[] = {EMFILE, ENFILE, ENOMEM, ENOBUFS, ECONNABORTED};

mode_t ModeIn(int flags, va_list rest) {
  return (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(rest, unsigned)) : 0;
}

int Open(int folder, const char* path, int flags, mode_t mode) {
  if (Fails(&Control::files)) return Fail(kOpenErrors);
  return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

ssize_t read(int fd, void* to, std::size_t size) {
  if (Fails(&Control::input) && !OnlyPart(size)) return Fail(kReadErrors);
  return syscall(SYS_read, fd, to, size);
}
ssize_t pread64(int fd, void* to, std::size_t size, off64_t at) {
  if (Fails(&Control::input) && !OnlyPart(size)) return Fail(kReadErrors);
  return syscall(SYS_pread64, fd, to, size, at);
}
ssize_t pread(int fd, void* to, std::size_t size, off_t at) { return pread64(fd, to, size, at); }
ssize_t recv(int fd, void* to, std::size_t size, int flags) {
  if (Fails(&Control::input) && !OnlyPart(size)) return Fail(kSocketErrors);
  return syscall(SYS_recvfrom, fd, to, size, flags, nullptr, nullptr);
}

ssize_t write(int fd, const void* from, std::size_t size) {
  if (Fails(&Control::output) && !OnlyPart(size)) return Fail(kWriteErrors);
  return syscall(SYS_write, fd, from, size);
}
ssize_t pwrite64(int fd, const void* from, std::size_t size, off64_t at) {
  if (Fails(&Control::output) && !OnlyPart(size)) return Fail(kWriteErrors);
  return syscall(SYS_pwrite64, fd, from, size, at);
}
ssize_t pwrite(int fd, const void* from, std::size_t size, off_t at) {
  return pwrite64(fd, from, size, at);
}
ssize_t send(int fd, const void* from, std::size_t size, int flags) {
  if (Fails(&Control::output) && !OnlyPart(size)) return Fail(kSocketErrors);
  return syscall(SYS_sendto, fd, from, size, flags, nullptr, 0);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = ModeIn(flags, rest);
  va_end(rest);
  return Open(AT_FDCWD, path, flags, mode);
}
int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = ModeIn(flags, rest);
  va_end(rest);
  return Open(AT_FDCWD, path, flags, mode);
}
int fsync(int fd) {
  if (Fails(&Control::synced)) return Fail(kSyncErrors);
  return static_cast<int>(syscall(SYS_fsync, fd));
}
int fdatasync(int fd) {
  if (Fails(&Control::synced)) return Fail(kSyncErrors);
  return static_cast<int>(syscall(SYS_fdatasync, fd));
}
int accept4(int fd, sockaddr* address, socklen_t* length, int flags) {
  if (Fails(&Control::accepted)) return Fail(kAcceptErrors);
  return static_cast<int>(syscall(SYS_accept4, fd, address, length, flags));
}

void* mmap64(void* at, std::size_t size, int protection, int flags, int fd, off64_t offset) {
  if (Fails(&Control::memory)) {
    errno = ENOMEM;
    return MAP_FAILED;
  }
  const long place = syscall(SYS_mmap, at, size, protection, flags, fd, offset);
  return reinterpret_cast<void*>(place);  // NOLINT(performance-no-int-to-ptr)
}
void* mmap(void* at, std::size_t size, int protection, int flags, int fd, off_t offset) {
  return mmap64(at, size, protection, flags, fd, offset);
}
void* malloc(std::size_t size) {
  if (!Fails(&Control::memory, true)) return __libc_malloc(size);
  errno = ENOMEM;
  return nullptr;
}
void* calloc(std::size_t count, std::size_t size) {
  if (!Fails(&Control::memory, true)) return __libc_calloc(count, size);
  errno = ENOMEM;
  return nullptr;
}
void* realloc(void* old, std::size_t size) {
  if (!Fails(&Control::memory, true)) return __libc_realloc(old, size);
  errno = ENOMEM;
  return nullptr;
}

}  // extern "C"
