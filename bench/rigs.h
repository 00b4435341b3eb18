// The rigs of the comparison: one actuator behind one ISO 6358 element at constant source pressure.
//
// Ranges (L: drawn evenly in the logarithm, otherwise evenly):
//   p_a 80–105 kPa · p_op/p_a 1.1–4 L · p_s/p_op 1.02–4 L · ε 1–4 · V0 1–500 mL L ·
//   C 0.005–2 dm³/(s·bar) L · b 0.1–0.5
#ifndef PLENUM_BENCH_RIGS_H_
#define PLENUM_BENCH_RIGS_H_

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plenum::bench {

// Isothermal at the reference temperature; pressures absolute.
struct RiseRig {
  double ambient_pa;
  double operating_pa;
  double source_pa;
  double expansion_ratio;
  double rest_volume_m3;
  double conductance_m3_per_s_pa;  // C
  double critical_ratio;           // b

  // Where the rise ends: 95 % of the operating gauge pressure.
  double TargetPa() const { return ambient_pa + 0.95 * (operating_pa - ambient_pa); }
};

// The same rigs on every machine for the same seed.
std::vector<RiseRig> RandomRigs(std::uint64_t seed, std::size_t count);

// One text line for the table's conditions.
std::string DescribeRanges();

// CSV with a header line: the fields of RiseRig, then target_pa and reference_s, in 17 digits.
void WriteRigs(const std::string& path, const std::vector<RiseRig>& rigs,
               const std::vector<double>& reference_s);

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_RIGS_H_
