#pragma once
// Files that other files name: the images of a recipe, the buffers of a glTF file, the materials of an OBJ.

namespace pelage {

/// Files may come from anywhere, and may name any file of this machine. What they name is read only if it lies in their
/// own folder or below it, unless this is allowed. One setting for the process, not to be changed while others read.
void allow_outside_files(bool allowed);

}  // namespace pelage
