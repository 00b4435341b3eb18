#include "api/catalogue/rows/revision_rows.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plenum::api {

PartRows::PartRows(PartVector parts) : base_(std::make_shared<Base>(std::move(parts))) {
  rows_.reserve(base_->parts->size());
  for (const catalog::Part& part : *base_->parts) rows_.push_back(&part);
  base_rows_.resize(rows_.size());
  std::iota(base_rows_.begin(), base_rows_.end(), 0u);
}

PartRows::PartRows(const PartRows& before, catalog::PartChanges changes, std::vector<Run>& runs)
    : base_(before.base_), added_(before.added_), changes_(before.changes_ + changes.size()) {
  runs.clear();
  runs.reserve(changes.size() + 1);
  added_.reserve(added_.size() + changes.size());
  std::size_t row = 0;
  while (!changes.empty()) {
    auto change = changes.extract(changes.begin());
    const std::string& id = change.key();
    const std::size_t place = before.LowerBound(id, row);
    const catalog::Part* now = nullptr;
    if (auto& part = change.mapped())
      now = added_.emplace_back(std::make_shared<const catalog::Part>(*std::move(part))).get();
    runs.push_back({row, place - row, now});
    row = place;
    if (row < before.size() && before[row].id == id) ++row;
  }
  runs.push_back({row, before.size() - row, nullptr});
  rows_ = Splice(before.rows_, runs, [](const catalog::Part& part) { return &part; });
  base_rows_ = Splice(before.base_rows_, runs, [](const catalog::Part&) { return kChanged; });
}

std::size_t PartRows::LowerBound(std::string_view id, std::size_t from) const {
  const auto found =
      std::lower_bound(rows_.begin() + static_cast<std::ptrdiff_t>(from), rows_.end(), id,
                       [](const catalog::Part* part, std::string_view wanted) {
                         return std::string_view(part->id) < wanted;
                       });
  return static_cast<std::size_t>(found - rows_.begin());
}

const catalog::Part* PartRows::Find(std::string_view id) const {
  const std::size_t row = LowerBound(id, 0);
  return row < size() && rows_[row]->id == id ? rows_[row] : nullptr;
}

PartVector PartRows::All() const {
  if (changes_ == 0) return base_->parts;
  std::call_once(all_made_, [this] {
    auto all = std::make_shared<std::vector<catalog::Part>>();
    all->reserve(size());
    for (const catalog::Part* part : rows_) all->push_back(*part);
    all_ = std::move(all);
  });
  return all_;
}

std::vector<std::uint8_t> PartRows::Search(std::string_view text) const {
  std::call_once(base_->search_made,
                 [this] { base_->search = std::make_unique<const PartSearch>(*base_->parts); });
  std::vector<std::uint8_t> of_base = base_->search->Find(text);
  if (changes_ == 0) return of_base;
  std::call_once(search_made_, [this] {
    std::vector<const catalog::Part*> changed;
    for (std::size_t row = 0; row < size(); ++row)
      if (base_rows_[row] == kChanged) changed.push_back(rows_[row]);
    search_ = std::make_unique<const PartSearch>(changed);
  });
  const std::vector<std::uint8_t> of_changed = search_->Find(text);
  std::vector<std::uint8_t> grades(size());
  auto changed = of_changed.begin();
  for (std::size_t row = 0; row < size(); ++row)
    grades[row] = base_rows_[row] == kChanged ? *changed++ : of_base[base_rows_[row]];
  return grades;
}

}  // namespace plenum::api
