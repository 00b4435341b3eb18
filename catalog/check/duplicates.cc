#include "catalog/check/duplicates.h"

#include <algorithm>
#include <map>
#include <set>

#include "catalog/fields/fields.h"
#include "catalog/tables/heading_words.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::size_t kTellingNumber = 5;
constexpr std::string_view kLegalForms[] = {"gmbh", "ag",          "kg",      "se",  "inc",
                                            "ltd",  "llc",         "corp",    "co",  "company",
                                            "bv",   "corporation", "limited", "srl", "spa"};

std::string Squeezed(std::string_view text) {
  std::string squeezed = PlainWords(text);
  std::erase(squeezed, ' ');
  return squeezed;
}

std::string MakerKey(std::string_view maker) {
  std::string key;
  const std::string words = PlainWords(maker);
  for (const std::string_view word : Split(words, ' '))
    if (std::find(std::begin(kLegalForms), std::end(kLegalForms), word) == std::end(kLegalForms))
      key += word;
  return key;
}

// "SMC VQ110" of the maker SMC is VQ110.
std::string NumberKey(std::string_view number, const std::string& maker) {
  std::string key = Squeezed(number);
  if (key.size() > maker.size() && key.starts_with(maker)) key.erase(0, maker.size());
  return key;
}

bool Tells(const std::string& key) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return key.size() >= kTellingNumber && std::any_of(key.begin(), key.end(), is_digit) &&
         !std::all_of(key.begin(), key.end(), is_digit);
}

bool HaveEqualNumbers(const Part& one, const Part& other) {
  int shared = 0;
  for (const auto& [field, number] : one.numbers) {
    const auto found = other.numbers.find(field);
    if (found == other.numbers.end() || field.starts_with("price_")) continue;
    if (found->second.value != number.value) return false;
    ++shared;
  }
  return shared > 0;
}

using Groups = std::map<std::string, std::vector<const Part*>>;

void Put(Groups& groups, const std::string& key, const Part& part) {
  auto& group = groups[key];
  if (group.empty() || group.back() != &part) group.push_back(&part);
}

class Finder {
 public:
  explicit Finder(std::string_view family) : family_(family) {}

  void Add(const Part& part) {
    const std::string maker = MakerKey(part.manufacturer);
    const std::string number = NumberKey(part.part_number, maker);
    if (number.empty()) return;
    const auto named = [&maker](std::string key) { return key.insert(0, maker + '|'); };
    Put(by_name_, named(number), part);
    Put(by_any_name_, named(number), part);
    for (const std::string& alias : part.aliases)
      if (const std::string key = NumberKey(alias, maker); !key.empty())
        Put(by_any_name_, named(key), part);
    if (Tells(number)) Put(by_number_, number, part);
  }

  std::vector<Duplicates> Found() {
    for (const auto& [key, group] : by_name_) Note(group, "same maker and part number");
    for (const auto& [key, group] : by_any_name_) Note(group, "a name of one is one of another's");
    for (const auto& [key, group] : by_number_) {
      std::vector<const Part*> alike = {group.front()};
      for (const Part* part : group)
        if (part != group.front() && HaveEqualNumbers(*group.front(), *part)) alike.push_back(part);
      Note(alike, "same part number and numbers, another maker");
    }
    std::sort(found_.begin(), found_.end(),
              [](const Duplicates& a, const Duplicates& b) { return a.ids < b.ids; });
    return std::move(found_);
  }

 private:
  void Note(const std::vector<const Part*>& group, const char* why) {
    std::set<std::string> ids;
    for (const Part* part : group) ids.insert(part->id);
    if (ids.size() < 2 || !told_.insert(ids).second) return;
    found_.push_back({std::string(family_), why, {ids.begin(), ids.end()}});
  }

  std::string_view family_;
  Groups by_name_, by_any_name_, by_number_;
  std::set<std::set<std::string>> told_;
  std::vector<Duplicates> found_;
};

}  // namespace

std::vector<Duplicates> FindDuplicates(const std::vector<Part>& parts) {
  std::vector<Duplicates> all;
  for (const Family& family : Families()) {
    Finder finder(family.name);
    for (const Part& part : parts)
      if (part.family == family.name) finder.Add(part);
    for (Duplicates& duplicates : finder.Found()) all.push_back(std::move(duplicates));
  }
  return all;
}

}  // namespace plenum::catalog
