// Places for those who are served at the same time; others queue for one.
#ifndef PLENUM_SERVER_WIRE_PLACES_H_
#define PLENUM_SERVER_WIRE_PLACES_H_

#include <deque>
#include <mutex>

namespace plenum::server {

// `Guest` has a field `has_place`.
template <typename Guest>
class Places {
 public:
  void Open(int count) { free_ = count; }

  // Whether the guest has a place now. Nobody passes those who queue.
  bool Take(Guest& guest) {
    if (guest.has_place) return true;
    const std::lock_guard lock(mutex_);
    if (!queue_.empty()) return false;
    return GiveTo(guest);
  }
  // Whether a place has become free since it was asked for; if not, the guest queues, and whoever
  // leaves next hands over to it.
  bool TakeOrQueue(Guest& guest) {
    const std::lock_guard lock(mutex_);
    if (queue_.empty() && GiveTo(guest)) return true;
    queue_.push_back(&guest);
    return false;
  }
  // The guest that has the place now, if one queued.
  Guest* Leave(Guest& guest) {
    if (!guest.has_place) return nullptr;
    guest.has_place = false;
    const std::lock_guard lock(mutex_);
    ++free_;
    if (queue_.empty()) return nullptr;
    Guest* next = queue_.front();
    queue_.pop_front();
    GiveTo(*next);
    return next;
  }

 private:
  bool GiveTo(Guest& guest) {
    if (free_ == 0) return false;
    --free_;
    return guest.has_place = true;
  }

  std::mutex mutex_;
  int free_ = 0;
  std::deque<Guest*> queue_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_PLACES_H_
