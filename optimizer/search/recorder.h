// Collects the proof record while the search runs.
#ifndef PLENUM_OPTIMIZER_SEARCH_RECORDER_H_
#define PLENUM_OPTIMIZER_SEARCH_RECORDER_H_

#include <memory>
#include <vector>

#include "optimizer/choices/plan.h"

namespace plenum::optimizer {

class Recorder {
 public:
  explicit Recorder(bool wanted) : wanted_(wanted) {}

  // A plan's first box. All of these do nothing, and give −1, where no record is wanted.
  int Start(const Plan& plan);
  std::pair<int, int> Split(int box, int slot, int middle);  // left and right part
  void Close(int box, const ProofBox& end);

  std::shared_ptr<const ProofRecord> Finish(const Problem& problem) const;

 private:
  struct Entry {
    ProofBox box;
    int left = -1, right = -1;
  };
  void Append(int root, std::vector<ProofBox>& boxes) const;

  bool wanted_;
  std::vector<Entry> entries_;
  std::vector<std::pair<const Plan*, int>> roots_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_RECORDER_H_
