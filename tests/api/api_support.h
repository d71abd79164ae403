// What the tests of the public interface have in common.
#pragma once

#include <gtest/gtest.h>
#include <pelage/error.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace pelage::api {

/// The fault of what work() throws; 0 when it throws none.
template <class Work>
int fault_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return static_cast<int>(error.fault());
  }
  return 0;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of its own for every test, gone at its end.
class InFolder : public testing::Test {
 protected:
  InFolder() : folder_(std::filesystem::path(testing::TempDir()) / name()) {
    std::filesystem::create_directories(folder_);
  }
  ~InFolder() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& file) const { return (folder_ / file).string(); }

 private:
  static std::string name() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    return std::string("pelage_api_") + test.test_suite_name() + "_" + test.name();
  }
  std::filesystem::path folder_;
};

}  // namespace pelage::api
