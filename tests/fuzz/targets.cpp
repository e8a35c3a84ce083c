#include "tests/fuzz/targets.h"

#include <array>

namespace quadrig::fuzz {

std::span<const Target> targets() {
    static constexpr std::array kTargets{Target{"cigi", read_cigi, 2048},
                                         Target{"fdm", read_fdm, 2048},
                                         Target{"fdm_stream", read_fdm_stream, 4096},
                                         Target{"canaerospace", read_canaerospace, 1024},
                                         Target{"modbus", read_modbus, 1024},
                                         Target{"monitor", read_monitor, 2048},
                                         Target{"candump", read_candump, 256},
                                         Target{"capture", read_capture, 4096},
                                         Target{"recorded_frames", read_recorded_frames, 512},
                                         Target{"link_url", read_link_url, 256},
                                         Target{"scene", read_scene, 4096},
                                         Target{"appliance", read_appliance, 1024},
                                         Target{"camera_path", read_camera_path, 512},
                                         Target{"quality_ladder", read_quality_ladder, 2048}};
    return kTargets;
}

}  // namespace quadrig::fuzz
