// A folder with a page, for tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/support/test_folder.h"

namespace scree {

class WebFolder {
 public:
  /// Each page of a test has another name.
  explicit WebFolder(std::string name = "page") : name_(std::move(name)) {
    write("index.html", "<!doctype html><title>page</title>");
    write("status.html", "<!doctype html><title>status</title>");
    write("client.0123abcd.wasm", std::string("\0asm", 4));
    write("client.0123abcd.wasm.gz", "compressed wasm");
    write("main.js", "let a = 1;");
    write("parts/style.css", "body {}");
  }
  std::string path() const { return folder_ / (name_ + "/"); }
  /// A place outside of it.
  std::string beside(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = this->path() + name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }

 private:
  const std::string name_;
  TestFolder folder_;
};

}  // namespace scree
