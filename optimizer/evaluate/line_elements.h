// The elements of a line in the order in which air crosses them.
#ifndef PLENUM_OPTIMIZER_EVALUATE_LINE_ELEMENTS_H_
#define PLENUM_OPTIMIZER_EVALUATE_LINE_ELEMENTS_H_

#include <array>
#include <cstddef>
#include <span>

#include "model/flow/series.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

class Elements {
 public:
  void Add(const model::FlowElement& element, int count = 1) {
    for (int i = 0; i < count; ++i) all_[size_++] = element;
  }
  std::span<const model::FlowElement> span() const { return {all_.data(), size_}; }

 private:
  std::array<model::FlowElement, model::kMaxSeriesElements> all_{};
  std::size_t size_ = 0;
};

// The parts of a line by what they pass; `valve` in the direction of the stroke.
struct LinePassages {
  const model::FlowElement& valve;
  const model::FlowElement& fitting;
  const model::FlowElement& bore;
};

// Half of the fittings stand at the valve, one more of an odd number.
inline Elements ElementsOf(const ActuatorGroup& group, const LinePassages& line, bool inward,
                           bool past_valve = false) {
  const int at_valve = (group.fittings_per_line + 1) / 2;
  const int at_actuator = group.fittings_per_line - at_valve;
  Elements crossed;
  if (inward && !past_valve) crossed.Add(line.valve);
  crossed.Add(line.fitting, inward ? at_valve : at_actuator);
  crossed.Add(line.bore);
  crossed.Add(line.fitting, inward ? at_actuator : at_valve);
  if (!inward && !past_valve) crossed.Add(line.valve);
  return crossed;
}

// Between source and actuator, and between actuator and ambient: air leaves an evacuated actuator
// while it is filled. A valve that only vents is not on the way from the source.
inline Elements FillElements(const ActuatorGroup& group, const LinePassages& line) {
  return ElementsOf(group, line, !group.chamber.evacuated, group.fed_past_valve);
}
inline Elements ExhaustElements(const ActuatorGroup& group, const LinePassages& line) {
  return ElementsOf(group, line, group.chamber.evacuated);
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_LINE_ELEMENTS_H_
