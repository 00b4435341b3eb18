#include "server/jobs/job_memory.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace plenum::server {

std::size_t ResidentBytes() {
  std::size_t pages = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  if (std::fscanf(file, "%zu %zu", &pages, &resident) != 2) resident = 0;
  std::fclose(file);
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void ReturnFreeMemory() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  malloc_trim(0);
}

std::unique_ptr<JobMemory::Share> JobMemory::Enter() {
  std::unique_ptr<Share> share(new Share(*this));
  const std::lock_guard lock(mutex_);
  if (shares_.empty()) before_ = resident_();
  shares_.push_back(share.get());
  return share;
}

void JobMemory::Report(Share& share, long long open) {
  const std::lock_guard lock(mutex_);
  share.open_ = open;
  if (resident_() <= before_ + bytes_max_) return;
  // One that was asked frees its memory first.
  if (std::any_of(shares_.begin(), shares_.end(), [](const Share* one) { return one->must_end(); }))
    return;
  Share* const largest = *std::max_element(
      shares_.begin(), shares_.end(),
      [](const Share* one, const Share* other) { return one->open_ < other->open_; });
  largest->must_end_ = true;
}

void JobMemory::Leave(Share& share) {
  const std::lock_guard lock(mutex_);
  std::erase(shares_, &share);
}

}  // namespace plenum::server
