// Expected numbers come from the formula at the top of oqpsk_error_rate.hpp, evaluated with 60
// decimal digits.
#include "netsim/phy/oqpsk_error_rate.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "netsim/phy/oqpsk_mode.hpp"
#include "netsim/units.hpp"
#include "support/error_model.hpp"

namespace netsim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double success(double snir, int psdu_bytes) {
    return OqpskErrorModel().success_probability(oqpsk_250_kbps, snir, psdu_bytes);
}

TEST(OqpskErrorModel, BitErrorsAndSuccessAreThoseOfTheFormula) {
    struct Point {
        double snir;
        double bit_error;
        double success_20_bytes;
        double success_127_bytes;
    };
    for (const Point& point : {
             Point{0.05, 0.41250400016051492, 2.2124061105387863e-41, 4.1027132291602063e-239},
             Point{0.2, 0.17468870726577715, 2.1121785011216326e-15, 8.9034188468939585e-87},
             Point{0.5, 0.016588050045775522, 0.052655617892528504, 3.1843201762878878e-08},
             Point{0.7, 0.0027651716385460419, 0.61425549934433699, 0.057405805183724096},
             Point{1.0, 0.00016152668792294791, 0.97196936421245628, 0.8464458859439592},
             Point{1.5, 1.1920710913940495e-06, 0.99979021737031737, 0.9987705383084996},
             Point{2.0, 8.2000598195154322e-09, 0.99999855679050731, 0.99999153757403814},
             Point{3.0, 3.7422718396774598e-13, 0.99999999993413602, 0.9999999996137976},
             Point{3.9, 4.6192411718100652e-17, 0.9999999999999919, 0.99999999999995237},
         }) {
        // The sum has terms up to 13000 with changing signs, and the success is a thousand-fold
        // product.
        EXPECT_NEAR(OqpskErrorModel::bit_error_rate(point.snir) / point.bit_error, 1, 1e-12) << point.snir;
        EXPECT_NEAR(success(point.snir, 20) / point.success_20_bytes, 1, 1e-10) << point.snir;
        EXPECT_NEAR(success(point.snir, 127) / point.success_127_bytes, 1, 1e-9) << point.snir;
    }
}

// IEEE Std 802.15.4-2006, 6.1.7 and 6.5.3.3: less than 1 % of packets of 20 octets are lost at
// the sensitivity. The standard's own curve (figure E.2) has bit errors of 1e-9 at about 4 dB less
// than the 8 dB of plain QPSK.
TEST(OqpskErrorModel, AtTwoDecibelsNearlyEveryPacketOf20BytesIsReceived) {
    EXPECT_GT(success(ratio_from_db(2), 20), 0.99);
    EXPECT_LT(success(ratio_from_db(-3), 20), 0.1);
}

TEST(OqpskErrorModel, WithoutSignalBitsAreGuessed) {
    EXPECT_NEAR(OqpskErrorModel::bit_error_rate(0), 0.5, 1e-13);
}

TEST(OqpskErrorModel, EverythingIsDecodedWithoutNoise) {
    EXPECT_EQ(success(infinity, 127), 1);
}

TEST(OqpskErrorModel, TheShortCutForStrongSignalsChangesNoDigit) {
    EXPECT_GT(OqpskErrorModel::bit_error_rate(4), 0);
    EXPECT_LT(OqpskErrorModel::bit_error_rate(4), 1e-16);
    EXPECT_EQ(OqpskErrorModel::bit_error_rate(4.001), 0);
}

TEST(OqpskErrorModel, BitErrorsFallWithTheSnir) {
    double last = 1;
    for (int step = 0; step < 800; ++step) {
        const double bit_error = OqpskErrorModel::bit_error_rate(ratio_from_db(-30 + 0.05 * step));
        EXPECT_LE(bit_error, last) << step;
        EXPECT_GE(bit_error, 0) << step;
        last = bit_error;
    }
}

TEST(OqpskErrorModel, IsChosenByItsName) {
    EXPECT_EQ(test::error_model("Ieee802154ErrorModel").success_probability(oqpsk_250_kbps, 1, 20),
              success(1, 20));
}

}  // namespace
}  // namespace netsim
