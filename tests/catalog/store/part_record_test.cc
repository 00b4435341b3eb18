#include "catalog/store/part_record.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace part_record_test {

// As releases with schema 2 and 3 wrote it: hashes of their revisions rest on these bytes.
TEST(PartRecord, OfAPartWithoutDetailsIsWhatItWasBefore) {
  Part part = Reservoir("r");
  part.texts["port"] = {"1/8", Provenance::kEstimated, "rule"};
  const std::string record =
      "part,r,reservoir,Maker,R-r,user,\n"
      "number,body_volume_ml,500,datasheet,page 1\n"
      "number,internal_volume_ml,500,datasheet,page 1\n"
      "number,mass_kg,0.2,datasheet,page 1\n"
      "number,pressure_max_kpa_gauge,500,datasheet,page 1\n"
      "text,port,1/8,estimated,rule\n";
  EXPECT_EQ(FormatRecord(part), record);
  EXPECT_EQ(ParseRecord(record), part);
}

TEST(PartRecord, RoundTripsRandomParts) {
  std::mt19937 random(3);
  for (const Family& family : Families())
    for (int i = 0; i < 50; ++i) {
      const Part part = AnyPart(family, "p", random);
      EXPECT_EQ(ParseRecord(FormatRecord(part)), part);
    }
}

// Each of the new fields enters the record, and so the hash.
TEST(PartRecord, EveryDetailTells) {
  const Part plain = Reservoir("r");
  std::vector<Part> changed(7, plain);
  changed[0].series = "s";
  changed[1].orderable = false;
  changed[2].aliases = {"a"};
  changed[3].offers = {{"Shop", 1, "EUR", 1, "", ""}};
  changed[4].documents = {{"sheet", ""}};
  changed[5].numbers["mass_kg"].uncertainty = 0.1;
  changed[6].orderable = true;
  std::set<std::string> records{FormatRecord(plain)};
  for (const Part& part : changed) EXPECT_TRUE(records.insert(FormatRecord(part)).second);
}

TEST(PartRecord, RefusesWhatIsNone) {
  const std::string head = "part,r,reservoir,Maker,R-r,user,\n";
  EXPECT_TRUE(ParseRecord(head));
  for (const char* line :
       {"series\n", "series,a,b\n", "orderable,maybe\n", "offer,Shop,x,EUR,1,,\n", "document,a\n",
        "number,mass_kg,1,datasheet,,x\n", "curve,datasheet,,datasheet,,x,\n", "price,1\n"})
    EXPECT_FALSE(ParseRecord(head + line)) << line;
}

}  // namespace part_record_test
}  // namespace plenum::catalog
