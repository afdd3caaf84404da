#pragma once
// The subcommands of `otter`. To add one: write its file with an `add_...` function, name it here, list it in
// CMakeLists.txt.

#include <array>
#include <functional>

#include "app/commands/arguments.h"
#include "base/result.h"

namespace app {

/// What a subcommand does once the command line is read. The value is the exit status; an Error is printed as
/// one line on stderr after the program's name, and its exit status used.
using Action = std::function<base::Result<int>()>;

/// One row of the table. `add` declares the options in `arguments` and returns the action that reads them;
/// the options' storage is owned by the action (a shared_ptr it captures). `examples` is printed under the
/// options by --help.
struct Command {
  const char* name;
  const char* help;
  Action (*add)(Arguments arguments);
  const char* examples;
};

Action add_compare(Arguments arguments);
Action add_cost(Arguments arguments);
Action add_effects(Arguments arguments);
Action add_gte_check(Arguments arguments);
Action add_list(Arguments arguments);
Action add_inspect(Arguments arguments);
Action add_merge(Arguments arguments);
Action add_play(Arguments arguments);
Action add_record(Arguments arguments);
Action add_regress(Arguments arguments);
Action add_render(Arguments arguments);
Action add_replay(Arguments arguments);
Action add_run(Arguments arguments);
Action add_slice(Arguments arguments);
Action add_walk(Arguments arguments);

/// In the order in which `otter --help` lists them.
inline constexpr std::array commands{
    Command{"run", "open the window", add_run,
            "  otter run\n"
            "  otter run cyclic --split\n"
            "  otter run model.obj --visibility zbuffer --depth 16 --size 640x480\n"},
    Command{"list", "the built-in scenes and what each shows", add_list,
            "  otter list --long\n"
            "  otter list --names\n"},
    Command{"render", "draw one frame into a PNG, without a window", add_render,
            "  otter render crates -o crates.png\n"
            "  otter render cyclic -o cyclic.png --visibility zbuffer --frame 120 --size 640x480\n"
            "  otter render model.obj -o model.png --buckets 4096 --key farthest\n"
            "  otter render game.psxgpu.zst -o frame.png --frame 120\n"
            "  otter render ram.bin --head 8012FFFC -o list.png\n"
            "  otter render --all -d pictures\n"},
    Command{"inspect", "which pixels a painter's order gets wrong, and why", add_inspect,
            "  otter inspect corridor --frame 30 --heatmap heat.png\n"
            "  otter inspect cyclic --pixel 160,120\n"
            "  otter inspect crates --frames 0..99 --buckets 4096 --json report.json --max 200\n"
            "  otter inspect recorded.psxgpu --frame 2 --visibility zbuffer --depth 16\n"
            "  otter inspect ram.bin --head 8012FFFC --table 8012F000,1024 --pixel 160,120\n"},
    Command{"replay", "feed a GPU dump to the GPU", add_replay,
            "  otter replay frame.psxgpu --vram vram.png\n"
            "  otter replay frame.psxgpu.zst --list --until 20\n"
            "  otter replay frame.psxgpu --list --json list.json\n"
            "  otter replay frame.psxgpu --until 3:17 --vram vram.png\n"
            "  otter replay frame.psxgpu --expect vram.bin --difference red.png\n"
            "  otter replay scene.psxgpu --visibility zbuffer --depth 16 -o frame.png\n"},
    Command{"play", "run a program of the console's SDK, in the window or without", add_play,
            "  otter play build/corridor\n"
            "  otter play build/corridor --frame 120 --paused --panel table\n"
            "  otter play build/corridor --frames 120 -o frame.png --pad 30:UP+X,60:\n"
            "  otter play build/corridor --frames 60 -o frame.png --visibility zbuffer --resolution 4\n"},
    Command{"record", "write a scene as a GPU dump", add_record,
            "  otter record crates -o crates.psxgpu\n"
            "  otter record cyclic -o cyclic.psxgpu.zst --frames 60 --annotate\n"},
    Command{"walk", "check and draw a list in a saved RAM image", add_walk,
            "  otter walk ram.bin --head 8012FFFC --table 8012F000,1024\n"
            "  otter walk ram.bin --head 80123000 --vram-in vram.bin --vram vram.png\n"},
    Command{"slice", "the few commands of a dump that some pixels depend on", add_slice,
            "  otter slice game.psxgpu --frame 12 --pixel 160,120 -o small.psxgpu\n"
            "  otter slice game.psxgpu.zst --frame 12 --pixel 100,80 --size 16x8 -o small.psxgpu\n"
            "  otter slice ram.bin --head 8012FFFC --pixel 160,120 --vram -o small.psxgpu\n"},
    Command{"compare", "where two dumps part: command, state and pixel", add_compare,
            "  otter compare before.psxgpu after.psxgpu\n"
            "  otter compare mine.psxgpu theirs.psxgpu.zst --json parting.json\n"},
    Command{"regress", "hold what every dump of a folder draws against what it drew", add_regress,
            "  otter regress dumps --update\n"
            "  otter regress dumps\n"
            "  otter regress dumps --shard 2/8 --json shard-2.json\n"},
    Command{"merge", "put the shards of otter regress together", add_merge,
            "  otter merge shard-1.json shard-2.json -o whole.json\n"},
    Command{"cost", "what every setting of accuracy costs in time, and the error it leaves", add_cost,
            "  otter cost crates --quick --html cost.html\n"
            "  otter cost --axes texture,antialias corridor --json cost.json\n"},
    Command{"effects", "the effects a frame calls for, and the price of each", add_effects,
            "  otter effects crates\n"
            "  otter effects game.psxgpu.zst --frame 120\n"
            "  otter effects glass --visibility zbuffer --antialias msaa-4 --json effects.json\n"},
    Command{"gte-check", "run register vectors through the GTE", add_gte_check,
            "  otter gte-check vectors.csv\n"
            "  otter gte-check vectors.csv --all\n"},
};

}  // namespace app
