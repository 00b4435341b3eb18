// What a reservoir's pump delivers along its table, with derivatives to the table's values.
#ifndef PLENUM_MODEL_FLOW_PUMP_TABLE_H_
#define PLENUM_MODEL_FLOW_PUMP_TABLE_H_

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "model/flow/scalar.h"
#include "model/physics/monotone_curve.h"

namespace plenum::model {

template <class T>
class PumpTable {
 public:
  PumpTable() = default;
  // Of a pump without a reservoir, whose table does not move.
  explicit PumpTable(const T& limit_pa) : limit_pa_(limit_pa) {}
  PumpTable(const MonotoneCurve& delivery, const T& limit_pa, const Lift& lift)
      : limit_pa_(limit_pa) {
    if constexpr (kIsDual<T>) Move(delivery, lift);
  }

  const T& limit_pa() const { return limit_pa_; }  // stop pressure or end of the table

  // A table as far as the limit; past the limit, where only trial stages go, it runs on without a
  // kink. Error control and dense output would not notice one in the part that is cut off.
  template <class X>
  X Along(const MonotoneCurve& table, const X& source_pa) const {
    if (source_pa < table.front()) return X(table.y().front());
    if (table.back() < limit_pa_ && source_pa > table.back()) return X(table.y().back());
    return CurveAt(table, source_pa);
  }

  // Of the reservoir's pump.
  T Delivery(const MonotoneCurve& table, const T& source_pa) const {
    T flow = Along(table, source_pa);
    if constexpr (kIsDual<T>)
      for (const Moved& moved : moved_)
        flow.v[moved.direction] += (Along(moved.table, source_pa.a) - flow.a) / moved.step;
    return flow;
  }

 private:
  // Of a difference between two tables, over the largest delivery; m³/s.
  static constexpr double kStep = 1e-6, kLeastDelivery = 1e-9;

  // The table a small step along a direction that moves its values. Its slopes follow from them, so
  // that each direction has a table of its own.
  struct Moved {
    int direction = 0;
    double step = 0.0;
    MonotoneCurve table;
  };

  void Move(const MonotoneCurve& table, const Lift& lift) {
    const double step = kStep * std::max(table.y().front(), kLeastDelivery);
    for (int j = 0; j < kDirectionsOf<T>; ++j) {
      std::vector<double> values(table.y().begin(), table.y().end());
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k] += step * lift.operator()<T>(table.y()[k]).v[j];
      if (std::equal(values.begin(), values.end(), table.y().begin())) continue;
      const std::span<const double> at = table.x();
      moved_.push_back({j, step, MonotoneCurve({at.begin(), at.end()}, std::move(values))});
    }
  }

  T limit_pa_ = T(-std::numeric_limits<double>::infinity());
  std::vector<Moved> moved_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_PUMP_TABLE_H_
