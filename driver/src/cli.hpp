// SPDX-License-Identifier: Apache-2.0
// The parser of the command line by name: its header takes seconds to compile, and most files only pass it on.
#pragma once

namespace CLI {
class App;
class Option;
}  // namespace CLI
