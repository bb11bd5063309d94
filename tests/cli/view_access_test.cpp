// Tests of who may send requests to the server of `kinemend view`.
#include "cli/view_access.hpp"

#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace kinemend::cli {
namespace {

const ViewAccess access("0123456789abcdef", 4321);

ViewRequest good() {
  return {"POST",        "/0123456789abcdef/run", "127.0.0.1:4321", "http://127.0.0.1:4321",
          "same-origin", "application/json"};
}

TEST(ViewAccess, LetsItsOwnPageIn) {
  EXPECT_EQ(access.refusal(good()), 0);
  EXPECT_EQ(access.action("/0123456789abcdef/run"), "run");
  // The browser sends no origin for an address that the user opens.
  EXPECT_EQ(access.refusal({"GET", "/0123456789abcdef/", "127.0.0.1:4321", "", "none", ""}), 0);
  EXPECT_EQ(access.action("/0123456789abcdef/"), "");
  EXPECT_EQ(access.address(), "http://127.0.0.1:4321/0123456789abcdef/");
}

TEST(ViewAccess, RefusesOtherHosts) {
  for (const char* host :
       {"localhost:4321", "evil.example:4321", "127.0.0.1", "127.0.0.1:80", ""}) {
    ViewRequest request = good();
    request.host = host;
    EXPECT_EQ(access.refusal(request), 403) << host;
  }
}

TEST(ViewAccess, RefusesOtherOrigins) {
  for (const char* origin : {"http://evil.example", "null", "http://127.0.0.1:80",
                             "https://127.0.0.1:4321", "http://localhost:4321"}) {
    ViewRequest request = good();
    request.origin = origin;
    EXPECT_EQ(access.refusal(request), 403) << origin;
  }
  for (const char* site : {"cross-site", "same-site"}) {
    ViewRequest request = good();
    request.site = site;
    EXPECT_EQ(access.refusal(request), 403) << site;
  }
}

TEST(ViewAccess, RefusesPathsWithoutTheToken) {
  for (const char* path :
       {"/", "", "/run", "/0123456789abcdef", "/0123456789abcdee/run", "/0123456789ABCDEF/run",
        "//0123456789abcdef/run", "/0123456789abcdefX/", "/../0123456789abcdef/"}) {
    ViewRequest request = good();
    request.path = path;
    EXPECT_EQ(access.refusal(request), 403) << path;
  }
}

TEST(ViewAccess, TakesNoFormsOfOtherPages) {
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded"}) {
    ViewRequest request = good();
    request.type = type;
    EXPECT_EQ(access.refusal(request), 415) << type;
  }
}

TEST(ViewAccess, HasAnotherTokenEachTime) {
  const std::string token = random_token();
  EXPECT_EQ(token.size(), 32u);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(token, random_token());
}

}  // namespace
}  // namespace kinemend::cli

namespace kinemend::test {
namespace {

using View = Program;
using testing::HasSubstr;

TEST_F(View, ReadsFilesOnlyAndNeverReplacesTheTake) {
  synth("walk.bvh");
  EXPECT_EQ(run({"view", "-", "--no-open"}).code, 2);
  EXPECT_EQ(run({"view", "none.bvh", "--no-open"}).code, 3);
  const Ran same = run({"view", "walk.bvh", "-o", "walk.bvh", "--force", "--no-open"});
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.err, HasSubstr("would be lost"));
  EXPECT_EQ(run({"view", "walk.bvh", "--plan", "walk.bvh", "--no-open"}).code, 2);
  EXPECT_EQ(run({"view", "walk.bvh", "--contacts", "walk.bvh", "--no-open"}).code, 2);
}

}  // namespace
}  // namespace kinemend::test
