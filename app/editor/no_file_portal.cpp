// FilePortal of builds without SI_FILE_PORTAL: answers every request with "no dialog", so that the editor opens its
// own.
#include <utility>

#include "app/editor/file_portal.h"

namespace si {

class FilePortal::Dialog {
public:
    Answer answer;
};

FilePortal::FilePortal(std::function<void()> wake) : wake_(std::move(wake)) {}
FilePortal::~FilePortal() = default;

void FilePortal::open_dialog(const DesktopFileDialog& request, const std::string&) {
    dialog_ = std::make_unique<Dialog>();
    dialog_->answer.job = request.job;
    dialog_->answer.problem = "this build does not ask the desktop for files (SI_FILE_PORTAL)";
    wake_();
}

std::optional<FilePortal::Answer> FilePortal::take_answer() {
    if (!dialog_) return std::nullopt;
    std::optional<Answer> answer = std::move(dialog_->answer);
    dialog_.reset();
    return answer;
}

}  // namespace si
