// The epoll set that threads take connections from.
#ifndef PLENUM_SERVER_WIRE_POLL_SET_H_
#define PLENUM_SERVER_WIRE_POLL_SET_H_

namespace plenum::server {

class PollSet {
 public:
  PollSet();  // throws std::runtime_error where there is none to be had
  ~PollSet();
  PollSet(const PollSet&) = delete;
  PollSet& operator=(const PollSet&) = delete;

  // Has one thread take `item` when the socket can be read, or written; once each time.
  enum class For { kReading, kWriting };
  bool Add(int socket, void* item) const;  // for reading
  void Arm(int socket, void* item, For what) const;
  // The next item; nullptr after WakeAll, and now and then.
  void* Take() const;
  // From now on all are given nullptr at once.
  void WakeAll() const;

 private:
  int epoll_, wake_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_POLL_SET_H_
