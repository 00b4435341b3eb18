// The pumps of a box, as far as bounds need them. Internal to verify*.cc.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_PUMP_CHOICES_H_
#define PLENUM_VERIFY_CORNER_VERIFY_PUMP_CHOICES_H_

#include <map>
#include <vector>

#include "verify/corner/verify_line.h"
#include "verify/design/verify_values.h"

namespace plenum::verify {

// Content, Pa·m³, of a cubic metre of air ANR: κ.
double ContentPerVolume(const Problem& problem);

// The best of several pumps over even cells of pressure.
inline constexpr std::size_t kPumpCells = 512;
// What is delivered, by finer ones: where it falls to nothing a stroke waits for little else.
inline constexpr std::size_t kFinePerCell = 4;
inline constexpr double kStartTolerance = 1e-3;  // relative; the safe end counts
struct PumpCells {
  std::vector<double> delivery_m3_per_s, energy_j_per_m3;
  std::vector<double> fine_m3_per_s;  // of finer cells
  // To fill a volume from ambient to a cell's lower end, per m³ of it; one more than there are
  // cells.
  std::vector<double> filling_j_per_m3;
  double highest_pa = 0.0, duty_max = 0.0, current_a = kUnlimited;
  // Where pumps hold on, of each group: what they take at its operating pressure; and what air
  // takes that flows at a pressure, beyond that power for as long, made non-falling.
  std::vector<double> holding_w;
  std::vector<std::vector<double>> beyond_j_per_m3;
};

class PumpChoices {
 public:
  using Range = std::pair<int, int>;  // of a slot's choices

  PumpChoices(const Problem& problem, const ProofPlan& plan);

  const PumpCells& CellsIn(Range compressors);
  double PressureOf(std::size_t cell) const { return pressures_pa_[cell]; }  // lower end
  std::size_t CellOf(double pressure_pa) const;                         // the last one if above all
  double DeliveryAt(const PumpCells& pumps, double pressure_pa) const;  // at least the true one

 private:
  PumpCells CellsOf(const ProofItem& item) const;

  const Problem& problem_;
  const std::vector<model::Compressor>& pumps_;
  int compressor_;                    // slot
  double highest_pa_;                 // of any compressor
  std::vector<double> pressures_pa_;  // of cells
  std::vector<PumpCells> items_;      // of single choices
  std::map<Range, PumpCells> ranges_;
};

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_PUMP_CHOICES_H_
