#include "bench/rigs.h"

#include <cmath>
#include <fstream>
#include <iomanip>
#include <random>
#include <stdexcept>

namespace plenum::bench {
namespace {

// std::uniform_real_distribution may differ between standard libraries; the engine may not.
double Even(std::mt19937_64& engine, double low, double high) {
  const double unit = static_cast<double>(engine() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

double EvenInLog(std::mt19937_64& engine, double low, double high) {
  return low * std::pow(high / low, Even(engine, 0.0, 1.0));
}

}  // namespace

std::vector<RiseRig> RandomRigs(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 engine(seed);
  std::vector<RiseRig> rigs(count);
  for (RiseRig& rig : rigs) {
    rig.ambient_pa = Even(engine, 80e3, 105e3);
    rig.operating_pa = rig.ambient_pa * EvenInLog(engine, 1.1, 4.0);
    rig.source_pa = rig.operating_pa * EvenInLog(engine, 1.02, 4.0);
    rig.expansion_ratio = Even(engine, 1.0, 4.0);
    rig.rest_volume_m3 = EvenInLog(engine, 1e-6, 500e-6);
    rig.conductance_m3_per_s_pa = EvenInLog(engine, 0.005e-8, 2e-8);
    rig.critical_ratio = Even(engine, 0.1, 0.5);
  }
  return rigs;
}

std::string DescribeRanges() {
  return "p_a 80-105 kPa, p_op/p_a 1.1-4 (log), p_s/p_op 1.02-4 (log), eps 1-4, "
         "V0 1-500 mL (log), C 0.005-2 dm3/(s bar) (log), b 0.1-0.5";
}

void WriteRigs(const std::string& path, const std::vector<RiseRig>& rigs,
               const std::vector<double>& reference_s) {
  std::ofstream file(path);
  file << "ambient_pa,operating_pa,source_pa,expansion_ratio,rest_volume_m3,"
          "conductance_m3_per_s_pa,critical_ratio,target_pa,reference_s\n"
       << std::setprecision(17);
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const RiseRig& rig = rigs[i];
    file << rig.ambient_pa << ',' << rig.operating_pa << ',' << rig.source_pa << ','
         << rig.expansion_ratio << ',' << rig.rest_volume_m3 << ',' << rig.conductance_m3_per_s_pa
         << ',' << rig.critical_ratio << ',' << rig.TargetPa() << ',' << reference_s[i] << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace plenum::bench
