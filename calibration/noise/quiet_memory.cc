#include "calibration/noise/quiet_memory.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace plenum::calibration {
namespace {

constexpr std::array<std::size_t, 5> kLengths = {384, 192, 96, 48, 24};  // of a block, in samples
constexpr std::size_t kLeastLength = 12;
constexpr double kSamplesMost = 6000.0;                // of all runs, evenly chosen
constexpr double kThetasInABlock = 2.0;                // a longer memory is not told from a bend
constexpr double kThetaLeast = 0.4, kThetaStep = 1.3;  // of the spacing
constexpr std::size_t kShares = 10;
constexpr int kTerms = 4;  // of a cubic
constexpr double kWild =
    6.0;  // times the variance that a quarter of the run's blocks undercut: not quiet
constexpr double kGain = 7.0;         // of −2·ln L that two numbers must bring
constexpr double kShorter = 0.7;      // by how much blocks must shrink to be worth a comparison
constexpr double kAllowed = 14.0;     // 99.9 % of χ² with two degrees of freedom
constexpr double kShortMemory = 4.5;  // spacings: may always be
constexpr double kThetaError = 2.0;   // times the likeliest θ
constexpr double kAgrees = 6.0;       // 95 % of χ² with two degrees of freedom

struct Block {
  std::size_t run = 0;
  std::vector<double> t_s;
  Eigen::MatrixXd columns;  // the cubic's and the readings
};

Block BlockOf(const QuietStretch& stretch, std::size_t first, std::size_t end, std::size_t run) {
  Block block{run,
              {stretch.t_s.begin() + static_cast<std::ptrdiff_t>(first),
               stretch.t_s.begin() + static_cast<std::ptrdiff_t>(end)},
              {}};
  const auto rows = static_cast<Eigen::Index>(end - first);
  block.columns.resize(rows, kTerms + 1);
  const double middle = 0.5 * (block.t_s.front() + block.t_s.back());
  const double half = 0.5 * (block.t_s.back() - block.t_s.front());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double u = (block.t_s[static_cast<std::size_t>(i)] - middle) / half;
    for (int k = 0; k < kTerms; ++k) block.columns(i, k) = std::pow(u, k);
    block.columns(i, kTerms) = stretch.y[first + static_cast<std::size_t>(i)];
  }
  return block;
}

std::vector<Block> BlocksOf(std::span<const QuietRecord> runs, std::size_t length) {
  std::vector<Block> blocks;
  for (std::size_t run = 0; run < runs.size(); ++run)
    for (const QuietStretch& stretch : runs[run]) {
      const std::size_t n = stretch.y.size();
      if (n < kLeastLength) continue;
      const std::size_t pieces = (n + length - 1) / length;
      for (std::size_t k = 0; k < pieces; ++k)
        blocks.push_back(BlockOf(stretch, k * n / pieces, (k + 1) * n / pieces, run));
    }
  return blocks;
}

// What a block adds: squares left by generalised least squares, and the two determinants.
struct Share {
  double squares = 0.0, logs = 0.0;
};

Share Fit(const Block& block, const NoiseMemory& memory) {
  Eigen::MatrixXd white = block.columns;
  Share share;
  InnovationSteps steps(memory);
  Eigen::RowVectorXd remembered = Eigen::RowVectorXd::Zero(white.cols());
  for (Eigen::Index i = 0; i < white.rows(); ++i) {
    const Innovation step = steps.Next(block.t_s[static_cast<std::size_t>(i)]);
    const Eigen::RowVectorXd off = white.row(i) - step.carry * remembered;
    remembered = step.carry * remembered + step.gain * off;
    white.row(i) = off * step.scale;
    share.logs -= 2.0 * std::log(step.scale);
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(white);
  for (int k = 0; k < kTerms; ++k) share.logs += 2.0 * std::log(std::abs(qr.matrixQR()(k, k)));
  share.squares = std::pow(qr.matrixQR()(kTerms, kTerms), 2);
  return share;
}

double Freedom(const Block& block) { return static_cast<double>(block.t_s.size()) - kTerms; }

// Leaves out blocks where the signal is far from a cubic, and of the rest as many as are enough.
void KeepQuiet(std::vector<Block>& blocks, std::size_t runs) {
  std::vector<std::vector<double>> variances(runs);
  std::vector<double> of_block;
  for (const Block& block : blocks) {
    of_block.push_back(Fit(block, {}).squares / Freedom(block));
    variances[block.run].push_back(of_block.back());
  }
  std::vector<double> usual(runs);
  for (std::size_t run = 0; run < runs; ++run) {
    if (variances[run].empty()) continue;
    const auto quarter =
        variances[run].begin() + static_cast<std::ptrdiff_t>(variances[run].size() / 4);
    std::nth_element(variances[run].begin(), quarter, variances[run].end());
    usual[run] = *quarter;
  }
  std::vector<Block> quiet;
  double samples = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!(of_block[i] > 0.0) || of_block[i] > kWild * usual[blocks[i].run]) continue;
    samples += static_cast<double>(blocks[i].t_s.size());
    quiet.push_back(std::move(blocks[i]));
  }
  const auto step = static_cast<std::size_t>(std::ceil(samples / kSamplesMost));
  blocks.clear();
  for (std::size_t i = 0; i < quiet.size(); i += step) blocks.push_back(std::move(quiet[i]));
}

// −2·ln L at a memory, and what each run's σ is then.
struct Likelihood {
  NoiseMemory memory;
  double misfit = 0.0;
  std::vector<double> log_sigma;
};

Likelihood LikelihoodOf(const std::vector<Block>& blocks, std::size_t runs,
                        const NoiseMemory& memory) {
  Likelihood result{memory, 0.0, std::vector<double>(runs)};
  std::vector<double> squares(runs), freedom(runs);
  for (const Block& block : blocks) {
    const Share share = Fit(block, memory);
    squares[block.run] += share.squares;
    freedom[block.run] += Freedom(block);
    result.misfit += share.logs;
  }
  for (std::size_t run = 0; run < runs; ++run) {
    const double log_variance = std::log(squares[run] / freedom[run]);  // NaN without blocks
    result.log_sigma[run] = 0.5 * log_variance;
    if (freedom[run] > 0.0) result.misfit += freedom[run] * log_variance;
  }
  return result;
}

// Memories of one length of block, all on the same grid.
struct Scan {
  std::vector<Block> blocks;
  Likelihood white;
  std::vector<Likelihood> memories;
  std::size_t likeliest = 0;
  double length = 0.0;  // of the block in which a sample lies, mean

  const Likelihood& best() const { return memories[likeliest]; }
};

Scan ScanOf(std::span<const QuietRecord> runs, double spacing_s, std::size_t length) {
  Scan scan;
  scan.blocks = BlocksOf(runs, length);
  KeepQuiet(scan.blocks, runs.size());
  double samples = 0.0;
  for (const Block& block : scan.blocks) {
    samples += static_cast<double>(block.t_s.size());
    scan.length += std::pow(static_cast<double>(block.t_s.size()), 2);
  }
  scan.length /= samples;
  scan.white = LikelihoodOf(scan.blocks, runs.size(), {});
  const double longest = static_cast<double>(kLengths.front()) / 5.0;
  for (double theta = kThetaLeast; theta < longest; theta *= kThetaStep)
    for (std::size_t k = 1; k <= kShares; ++k)
      scan.memories.push_back(LikelihoodOf(scan.blocks, runs.size(),
                                           {theta * spacing_s, static_cast<double>(k) / kShares}));
  const auto least = std::min_element(
      scan.memories.begin(), scan.memories.end(),
      [](const Likelihood& a, const Likelihood& b) { return a.misfit < b.misfit; });
  scan.likeliest = static_cast<std::size_t>(least - scan.memories.begin());
  return scan;
}

// σ over what memories are likely, and how far that leaves it open.
std::vector<QuietMemory::Level> Levels(const Scan& scan, std::size_t runs) {
  std::vector<QuietMemory::Level> levels;
  std::vector<double> freedom(runs);
  for (const Block& block : scan.blocks) freedom[block.run] += Freedom(block);
  for (std::size_t run = 0; run < runs; ++run) {
    double weights = 0.0, mean = 0.0, square = 0.0;
    for (const Likelihood& one : scan.memories) {
      const double weight = std::exp(-0.5 * (one.misfit - scan.best().misfit));
      weights += weight;
      mean += weight * one.log_sigma[run];
      square += weight * one.log_sigma[run] * one.log_sigma[run];
    }
    mean /= weights;
    const double spread = std::max(0.0, square / weights - mean * mean);
    levels.push_back({std::exp(mean), std::sqrt(spread + 0.5 / freedom[run])});
  }
  return levels;
}

std::vector<NoiseMemory> Allowed(const Scan& scan, double most_s) {
  const double limit = std::min(scan.best().misfit, scan.white.misfit) + kAllowed;
  std::vector<NoiseMemory> allowed;
  if (!(scan.white.misfit > limit)) allowed.push_back({});
  for (const Likelihood& one : scan.memories)
    if (one.memory.theta_s <= most_s && !(one.misfit > limit)) allowed.push_back(one.memory);
  return allowed;
}

}  // namespace

QuietMemory MemoryOfQuiet(std::span<const QuietRecord> runs, double spacing_s) {
  std::optional<Scan> longer;
  for (const std::size_t length : kLengths) {
    Scan scan = ScanOf(runs, spacing_s, length);
    if (longer && scan.length > kShorter * longer->length) continue;
    if (longer && scan.memories[longer->likeliest].misfit - scan.best().misfit < kAgrees) break;
    const bool white = scan.white.misfit - scan.best().misfit < kGain;
    if (white || length == kLengths.back())
      return {{}, {}, Allowed(scan, kShortMemory * spacing_s)};
    longer.reset();
    const double longest_s = spacing_s * scan.length / kThetasInABlock;
    if (scan.best().memory.theta_s < longest_s) longer = std::move(scan);
  }
  const NoiseMemory& found = longer->best().memory;
  const double most_s = std::max(kShortMemory * spacing_s, kThetaError * found.theta_s);
  return {found, Levels(*longer, runs.size()), Allowed(*longer, most_s)};
}

}  // namespace plenum::calibration
