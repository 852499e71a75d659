// A file for one test, removed when the test ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "netsim/trace/octets.hpp"

namespace netsim::test {

class TemporaryFile {
public:
    TemporaryFile() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) /
                (std::string(test->test_suite_name()) + "." + test->name() + "." +
                 std::to_string(reinterpret_cast<std::uintptr_t>(this)));
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::filesystem::remove(path_); }

    std::string path() const { return path_.string(); }
    Octets content() const {
        std::ifstream file(path_, std::ios::binary);
        return Octets(std::istreambuf_iterator<char>(file), {});
    }

private:
    std::filesystem::path path_;
};

}  // namespace netsim::test
