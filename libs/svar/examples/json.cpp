#include <gslam/svar.h>

#include <cstdio>

int main() {
  gslam::JsonOptions options;
  options.comments = true;
  const char* const text = R"({
    "fps": 30,  // frames a second
    "camera": {"k": [535.4, 539.2, 320.1, 247.6]}
  })";
  gslam::Svar config = gslam::parseJson(text, "config.json", options);
  config.set("start", 1305031102.175304);
  std::printf("%s\n", gslam::printJson(config).c_str());
  try {
    gslam::parseJson("[1, 2,]", "list.json");
  } catch (const gslam::ParseError& error) {
    std::printf("%s\n", error.what());  // list.json:1:7: expected a value, found ']'
  }
}
