#pragma once
// The files of a coat: meshes, images, pictures.

#include "grow_report.h"
#include "grown_coat.h"
#include "pelage/recipe.h"
#include "pelage/render.h"

namespace pelage {

/// All but pictures. Tells the report of every file and of what it cannot hold.
void write_files(const GrowOptions& options, const Grown& grown, const ShapeFile& file, bool keep_shape,
                 const SaveOptions& form, const Progress& progress, GrowReport& report);

/// A picture of a coat: of flat grids their nodes as pixels.
Image draw_coat(const TriangleMesh& coat, const GrowOptions& options, const ShapeFile& file,
                const PictureOptions& picture, const Progress& progress);

void write_pictures(const GrowOptions& options, const Recipe& recipe, const Grown& grown, const ShapeFile& file,
                    const PictureOptions& picture, const Progress& progress, GrowReport& report);

}  // namespace pelage
