#include "netsim/phy/ber_table.hpp"

#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/units.hpp"
#include "support/temporary_file.hpp"

namespace netsim {
namespace {

constexpr const char* header = "bitrate_mbps,psdu_bytes,snir_db,success\n";

const Mode& mode(double mbps) {
    return mode_set("g(mixed)").mode_for_bitrate(mbps * 1e6);
}

// A model from the content of a file.
BerTableErrorModel model_of(const std::string& text) {
    const test::TemporaryFile file;
    std::ofstream(file.path()) << text;
    return BerTableErrorModel(file.path());
}

double data_success(const BerTableErrorModel& model, double mbps, double snir_db, int psdu_bytes) {
    return std::exp(model.log_data_success(mode(mbps), ratio_from_db(snir_db), psdu_bytes));
}

TEST(BerTable, IsInterpolatedInDecibels) {
    const auto model = model_of(std::string(header) + "24,100,10,0.2\n24,100,12,0.6\n24,100,16,1\n");
    EXPECT_NEAR(data_success(model, 24, 10, 100), 0.2, 1e-12);
    EXPECT_NEAR(data_success(model, 24, 11, 100), 0.4, 1e-12);
    EXPECT_NEAR(data_success(model, 24, 13, 100), 0.7, 1e-12);
}

TEST(BerTable, EndsAsItsLastPoints) {
    const auto model = model_of(std::string(header) + "24,100,10,0.2\n24,100,12,0.6\n");
    EXPECT_NEAR(data_success(model, 24, -50, 100), 0.2, 1e-12);
    EXPECT_NEAR(data_success(model, 24, 50, 100), 0.6, 1e-12);
}

TEST(BerTable, NothingSurvivesASuccessOfNothing) {
    const auto model = model_of(std::string(header) + "24,100,10,0\n24,100,12,1\n");
    EXPECT_EQ(data_success(model, 24, 9, 1), 0);
    EXPECT_EQ(data_success(model, 24, 9, 0), 1);  // of nothing, all
}

TEST(BerTable, OtherLengthsAreThePowerOfTheNearestByRatio) {
    const auto model = model_of(std::string(header) + "24,100,10,0.5\n24,1000,10,0.25\n");
    EXPECT_NEAR(data_success(model, 24, 10, 200), 0.25, 1e-12);
    EXPECT_NEAR(data_success(model, 24, 10, 500), 0.5, 1e-12);
    EXPECT_NEAR(data_success(model, 24, 10, 2000), 0.0625, 1e-12);
}

TEST(BerTable, TheHeaderIsAShortFrameAtItsOwnRate) {
    const auto model = model_of(std::string(header) + "6,30,3,0.1\n1,60,3,0.2\n");
    EXPECT_NEAR(std::exp(model.log_header_success(mode(54), ratio_from_db(3))), std::pow(0.1, 0.1), 1e-12);
    EXPECT_NEAR(std::exp(model.log_header_success(mode(11), ratio_from_db(3))), std::pow(0.2, 0.1), 1e-12);
}

TEST(BerTable, BitratesItLacksFollowTheNistModel) {
    const auto model = model_of(std::string(header) + "6,30,3,0.1\n");
    EXPECT_EQ(model.log_data_success(mode(24), 18, 100),
              NistErrorModel(despreading_rates).log_data_success(mode(24), 18, 100));
    EXPECT_EQ(model.log_header_success(mode(1), 1),
              NistErrorModel(despreading_rates).log_header_success(mode(1), 1));
}

TEST(BerTable, CommentsEmptyLinesAndTheEndsOfLinesOfWindowsAreNoMatter) {
    const auto model =
        model_of("# measured\r\n\r\nbitrate_mbps,psdu_bytes,snir_db,success\r\n24,100,10,0.2\r\n");
    EXPECT_NEAR(data_success(model, 24, 10, 100), 0.2, 1e-12);
}

// The error message about a file, without its name.
std::string refusal_of(const std::string& text) {
    const test::TemporaryFile file;
    std::ofstream(file.path()) << text;
    const std::string error = error_text([&] { BerTableErrorModel{file.path()}; });
    const std::string place = "radio.ber_table_file = \"" + file.path() + "\": ";
    EXPECT_EQ(error.substr(0, place.size()), place);
    return error.substr(place.size());
}

TEST(BerTable, WhatIsMalformedIsRefusedAtItsLine) {
    const std::string start = header;
    EXPECT_EQ(refusal_of("6,100,3,0.5\n"),
              "line 1: \"6,100,3,0.5\": expected the line " + start.substr(0, start.size() - 1));
    EXPECT_EQ(refusal_of(start + "6,100,3\n"),
              "line 2: \"6,100,3\": expected four numbers, bitrate_mbps,psdu_bytes,snir_db,success");
    EXPECT_EQ(refusal_of(start + "\n6,100,3dB,1\n"), "line 3: \"3dB\": expected a number");
    EXPECT_EQ(refusal_of(start + "7,100,3,1\n"),
              "line 2: bitrate_mbps = 7: expected the bitrate of a mode, one of 1, 2, 5.5, 6, 9, 11, 12, 18, "
              "24, 36, "
              "48, 54");
    EXPECT_EQ(refusal_of(start + "6,0.5,3,1\n"),
              "line 2: psdu_bytes = 0.5: expected an integer number of bytes >= 1");
    EXPECT_EQ(refusal_of(start + "6,100,3,1.5\n"), "line 2: success = 1.5: expected from 0 to 1");
    EXPECT_EQ(refusal_of(start + "6,100,3,0.5\n6,100,2,0.6\n"),
              "line 3: snir_db = 2: expected more than the 3 before it, of the same bitrate and length");
    EXPECT_EQ(refusal_of(start),
              "line 1: expected at least one line below bitrate_mbps,psdu_bytes,snir_db,success");
}

TEST(BerTable, AnotherEncodingIsRefusedWithTheByte) {
    const std::string expected =
        " is not a character of a number: expected a CSV file, a text with the line " +
        std::string(header).substr(0, std::string(header).size() - 1);
    EXPECT_EQ(refusal_of(std::string(header) + "24,100,10,0.5\n24,100,12\xB4,1\n"),
              "line 3: the byte 0xB4" + expected);
    EXPECT_EQ(refusal_of(std::string("\x7F"
                                     "ELF",
                                     4)),
              "line 1: the byte 0x7F" + expected);
    EXPECT_EQ(refusal_of(std::string("a\0b", 3)), "line 1: the byte 0x00" + expected);
}

TEST(BerTable, AByteOrderMarkIsNoMatter) {
    const auto model = model_of("\xEF\xBB\xBF" + std::string(header) + "24,100,10,0.2\n");
    EXPECT_NEAR(data_success(model, 24, 10, 100), 0.2, 1e-12);
}

TEST(BerTable, CommentsMayBeInAnyEncoding) {
    const auto model = model_of(
        "# Pr\xFC"
        "fstand\n" +
        std::string(header) + "24,100,10,0.2\n");
    EXPECT_NEAR(data_success(model, 24, 10, 100), 0.2, 1e-12);
}

TEST(BerTable, AnEmptyFileIsCalledOne) {
    EXPECT_EQ(refusal_of(""),
              "the file is empty; expected the line "
              "bitrate_mbps,psdu_bytes,snir_db,success, and at least one line below");
}

TEST(BerTable, AFolderIsCalledOne) {
    EXPECT_EQ(error_text([] { BerTableErrorModel{"/"}; }),
              "radio.ber_table_file = \"/\": expected a file that can be read, not a folder");
}

TEST(BerTable, AFileThatIsNotThereIsRefused) {
    RadioConfig config;
    config.error_model = "Ieee80211BerTableErrorModel";
    config.ber_table_file = "no such file";
    EXPECT_EQ(error_text([&] { make_error_model(config); }),
              "radio.ber_table_file = \"no such file\": expected a file that can be read");
}

}  // namespace
}  // namespace netsim
