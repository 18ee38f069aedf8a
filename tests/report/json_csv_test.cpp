// Objects of JSON as lines of CSV.

#include "report/json_csv.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace json_csv_test {

using Json = nlohmann::ordered_json;

TEST(JsonCsv, HasAColumnForEachKeyOfAnyObjectInTheirOrder) {
    const Json rows = Json::parse(R"([{"a":1,"b":{"c":2.5,"d":null}},{"a":"x,y","b":{"d":true},"e":[3,4]}])");
    EXPECT_EQ(csvOf(rows), "a,b_c,b_d,e\r\n1,2.5,,\r\n\"x,y\",,true,3; 4\r\n");
}

TEST(JsonCsv, SaysWhatAListOfObjectsIsAbout) {
    const Json rows = Json::parse(R"([{"missing":[{"what":"stencil","source":"s"},{"what":"depth"}]}])");
    EXPECT_EQ(csvOf(rows), "missing\r\nstencil; depth\r\n");
}

}  // namespace json_csv_test
}  // namespace gnomon
