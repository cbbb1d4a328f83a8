#include "io/base64.h"

#include <gtest/gtest.h>

namespace particle_surface_tracker {
namespace {

std::string base64(std::string_view bytes) {
  std::string text = ":";
  append_base64(text, bytes);
  return text.substr(1);
}

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\0\xff\xfe", 3)), "AP/+");
}

}  // namespace
}  // namespace particle_surface_tracker
