// Whole packs: problems whose parts are sold in them, and what they cost, found by counting.
#ifndef PLENUM_TESTS_SUPPORT_PACKS_PACKS_BY_HAND_H_
#define PLENUM_TESTS_SUPPORT_PACKS_PACKS_BY_HAND_H_

#include <cstdint>

#include "optimizer/evaluate/candidate.h"

namespace plenum::test {

// Most parts that the sources and lines are made of come in packs; of joints, where asked for.
void SellInPacks(std::uint64_t seed, bool joints, optimizer::Problem& problem);

// What whole packs cost beyond pieces at price/pack, id by id.
double SurplusByHand(const optimizer::Problem& problem, const optimizer::Candidate& candidate);

}  // namespace plenum::test

#endif  // PLENUM_TESTS_SUPPORT_PACKS_PACKS_BY_HAND_H_
