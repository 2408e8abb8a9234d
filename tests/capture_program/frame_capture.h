// Capture of the commands between two points of a program by RenderDoc's library, for tests of `import-capture`.
#pragma once

#include <string>

namespace si::test {

/// Capture of a frame by librenderdoc.so, which is preloaded by the one who runs the program. Without the library all
/// functions do nothing, so that the program can be run by itself.
class FrameCapture {
public:
    /// @param path start of the capture's name, to which the library adds "_capture.rdc"
    explicit FrameCapture(const std::string& path);

    /// Begins the capture. A context must be current.
    void begin();

    /// Ends the capture and prints the name of its file as the last line. Returns false where nothing was captured.
    bool end();

private:
    void* api_ = nullptr;
};

}  // namespace si::test
