// FITS files of which not all can be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/damage.h"
#include "tests/support/fits_builder.h"

namespace timeseries {
namespace {

using namespace tests;
using namespace tests::fits;
using testing::HasSubstr;

// Beside one that is read: of too many axes, cut, or no HDU at all.
TEST(FitsDamaged, AnImageThatCannotBeReadCostsNoOther) {
    const std::vector<std::string> own{"PCOUNT  = 0", "GCOUNT  = 1"};
    const auto extension = [&](const std::vector<int>& axes, const std::string& bytes) {
        return image(16, axes, own, bytes, "XTENSION= 'IMAGE   '");
    };
    const std::string many = extension({2, 2, 2, 2, 2}, std::string(64, '\0')),
                      cut = extension({20, 20, 2000}, ""), noise(4500, '?');
    for (const auto& [more, why] :
         {std::pair(many, "three axes of space and one of time at most"),
          std::pair(cut, "bytes of values"), std::pair(noise, "expected a whole header")}) {
        const auto reader = openWritten(slab({}) + more);
        ASSERT_EQ(reader->variables().size(), 1u) << why;
        EXPECT_EQ(valuesOf<std::int16_t>(*reader), ramp<std::int16_t>(24));
        ASSERT_EQ(reader->damaged().size(), 1u) << why;
        EXPECT_EQ(reader->damaged()[0].name, "HDU 2");
        EXPECT_THAT(reader->damaged()[0].why, HasSubstr(why));
    }
}

TEST(FitsDamaged, WhatCannotBeReadIsNamed) {
    const auto path = freshFolder() / "file.fits";
    const auto refused = [&](const std::string& bytes) {
        writeBytes(path, bytes);
        return refusal(path);
    };
    const std::string whole = slab({});
    EXPECT_THAT(refused(whole.substr(0, 1000)), HasSubstr("expected"));
    EXPECT_THAT(refused(whole.substr(0, 2880)), HasSubstr("expected"));
    EXPECT_THAT(refused(image(16, {20000, 20000, 20000}, {}, "")), HasSubstr("bytes of values"));
    EXPECT_THAT(refused(whole.substr(0, 2880 + 40)), HasSubstr("expected 48 bytes of values"));
    EXPECT_THAT(refused(image(16, {1, 1, 1, 1, 1, 1, 1, 2, 2, 2}, {}, std::string(16, '\0'))),
                HasSubstr("expected"));
    EXPECT_THAT(refused(image(16, {}, {}, "")), HasSubstr("more than one pixel, found none"));
    EXPECT_THAT(
        refused(image(16, {2, 2, 2, 2, 2}, {}, bytesOf(ramp<std::int16_t>(32), std::endian::big))),
        HasSubstr("three axes of space and one of time at most, found 5"));
    std::mt19937 random(17);
    for (int trial = 0; trial < 2000; ++trial) {
        std::string damaged = slab({"CTYPE1  = 'RA---TAN'", "CDELT1  = 1.0", "BLANK   = 3"});
        for (int i = 0; i < 3; ++i) damaged[80 + random() % 720] = static_cast<char>(random());
        refused(damaged);  // a sentence, if it is one
    }
}

// Each number of the header by itself, then anything anywhere.
TEST(FitsDamaged, HostileHeadersAreReadOrRefusedInASentence) {
    const auto path = freshFolder() / "file.fits";
    const std::string whole = slab({"PCOUNT  = 0", "GCOUNT  = 1", "CRVAL1  = 1.0", "CDELT1  = 1.0",
                                    "CRPIX1  = 1.0", "BSCALE  = 2.0"});
    for (const std::string name : {"BITPIX", "NAXIS", "NAXIS1", "NAXIS2", "NAXIS3", "PCOUNT",
                                   "GCOUNT", "CRVAL1", "CDELT1", "CRPIX1", "BSCALE"})
        for (const std::string hostile :
             {"0", "1", "-1", "999", "2147483647", "-2147483648", "9223372036854775807",
              "99999999999999999999", "1e308", "1e999", "NaN", "'text'", ""}) {
            const std::size_t card = whole.find(name + std::string(8 - name.size(), ' ') + '=');
            ASSERT_EQ(card % 80, 0u) << name;
            std::string damaged = whole;
            damaged.replace(card + 10, 70, hostile + std::string(70 - hostile.size(), ' '));
            writeBytes(path, damaged);
            SCOPED_TRACE(name + " " + hostile);
            isRefusedInOneSentence(path);
        }
    writeBytes(path, whole);
    damageInRounds(path, path);
}

}  // namespace
}  // namespace timeseries
