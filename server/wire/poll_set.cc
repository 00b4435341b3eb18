#include "server/wire/poll_set.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <stdexcept>

namespace plenum::server {
namespace {

epoll_event EventOf(void* item, unsigned events) {
  epoll_event event{};
  event.events = events | EPOLLONESHOT;
  event.data.ptr = item;
  return event;
}

constexpr unsigned kReadable = EPOLLIN | EPOLLRDHUP;

}  // namespace

PollSet::PollSet()
    : epoll_(epoll_create1(EPOLL_CLOEXEC)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (epoll_ < 0 || wake_ < 0) throw std::runtime_error("no epoll set");
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = nullptr;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &event);
}

PollSet::~PollSet() {
  close(epoll_);
  close(wake_);
}

bool PollSet::Add(int socket, void* item) const {
  epoll_event event = EventOf(item, kReadable);
  return epoll_ctl(epoll_, EPOLL_CTL_ADD, socket, &event) == 0;
}

void PollSet::Arm(int socket, void* item, For what) const {
  epoll_event event = EventOf(item, what == For::kReading ? kReadable : unsigned{EPOLLOUT});
  epoll_ctl(epoll_, EPOLL_CTL_MOD, socket, &event);
}

void* PollSet::Take() const {
  epoll_event event{};
  return epoll_wait(epoll_, &event, 1, -1) == 1 ? event.data.ptr : nullptr;
}

void PollSet::WakeAll() const { eventfd_write(wake_, 1); }  // stays readable: every thread sees it

}  // namespace plenum::server
