// Memory of searches as a limit like time: where they take too much together, the one with the most
// boxes ends with the best that it has.
#ifndef PLENUM_SERVER_JOBS_JOB_MEMORY_H_
#define PLENUM_SERVER_JOBS_JOB_MEMORY_H_

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace plenum::server {

// Resident memory of the process (proc(5), statm).
std::size_t ResidentBytes();

// Free blocks of the heap go back to the system, for one thread at a time: glibc makes its heap
// ready without a lock, and where no block was ever taken from it (a sanitizer has its own) two
// threads would both count as the first (malloc/malloc.c, ptmalloc_init).
void ReturnFreeMemory();

class JobMemory {
 public:
  // `bytes_max`: of all searches together, beyond what the process had before the first of them.
  explicit JobMemory(std::size_t bytes_max, std::function<std::size_t()> resident = ResidentBytes)
      : bytes_max_(bytes_max), resident_(std::move(resident)) {}

  // One search, while it lives.
  class Share {
   public:
    // How many boxes are open now; to be called a few times a second. It may ask another search,
    // or this one, to end.
    void Report(long long open) { memory_.Report(*this, open); }
    bool must_end() const { return must_end_; }
    ~Share() { memory_.Leave(*this); }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

   private:
    friend class JobMemory;
    explicit Share(JobMemory& memory) : memory_(memory) {}
    JobMemory& memory_;
    std::atomic<bool> must_end_ = false;
    long long open_ = 0;
  };
  std::unique_ptr<Share> Enter();

 private:
  void Report(Share& share, long long open);
  void Leave(Share& share);

  const std::size_t bytes_max_;
  const std::function<std::size_t()> resident_;
  std::mutex mutex_;
  std::vector<Share*> shares_;
  std::size_t before_ = 0;  // the first of them
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOB_MEMORY_H_
