// Draws from a seed.
#ifndef PLENUM_TESTS_SUPPORT_RANDOM_H_
#define PLENUM_TESTS_SUPPORT_RANDOM_H_

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace plenum::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  // One of several streams of a seed.
  Random(std::uint64_t seed, std::uint64_t stream) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(stream)};
    generator_.seed(sequence);
  }

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  double Normal() { return std::normal_distribution<double>()(generator_); }
  bool Coin(double chance = 0.5) { return Uniform(0.0, 1.0) < chance; }
  double Sign() { return Coin() ? 1.0 : -1.0; }
  int Integer(int low, int high) {  // both included
    return std::uniform_int_distribution<int>(low, high)(generator_);
  }
  template <class T>
  const T& Pick(const std::vector<T>& of) {
    return of[static_cast<std::size_t>(Integer(0, static_cast<int>(of.size()) - 1))];
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_RANDOM_H_
