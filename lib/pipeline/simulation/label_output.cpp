#include "esi/io/output/output_file.hpp"
#include "esi/pipeline/simulation/sim_output.hpp"

namespace esi {
namespace {

class LabelOutput final : public SimOutput {
 public:
  explicit LabelOutput(const std::filesystem::path& folder) : file_(folder / "labels.u8") {}

  void take(const Simulator& simulator, const Packet& /*packet*/) override {
    static_assert(sizeof(EventCause) == 1);
    file_.write(std::as_bytes(simulator.causes()));
  }
  void finish() override { file_.commit(); }

 private:
  OutputFile file_;
};

}  // namespace

std::unique_ptr<SimOutput> open_label_output(const std::filesystem::path& folder) {
  return std::make_unique<LabelOutput>(folder);
}

}  // namespace esi
