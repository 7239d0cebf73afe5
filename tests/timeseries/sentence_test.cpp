#include "timeseries/sentence.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace timeseries {
namespace {

TEST(Sentence, IsWhatAnErrorOfOursSays) {
    EXPECT_EQ(sentenceOf(std::runtime_error("a.nc: expected a file")), "a.nc: expected a file");
}

TEST(Sentence, SaysWhatTheStandardLibraryLacks) {
    const std::system_error noThread(
        std::make_error_code(std::errc::resource_unavailable_try_again));
    EXPECT_EQ(sentenceOf(noThread),
              "no thread can be made: the system allows no more threads or processes");
    EXPECT_EQ(sentenceOf(std::bad_alloc()), "there is not enough memory for this");
    const std::system_error other(std::make_error_code(std::errc::io_error), "reading");
    EXPECT_EQ(sentenceOf(other), other.what());
}

}  // namespace
}  // namespace timeseries
