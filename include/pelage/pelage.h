#pragma once
// The whole public interface. Every part can be included by itself; render.h needs the library pelage::render, all
// others pelage::pelage.

#include "pelage/analyse.h"
#include "pelage/channel.h"
#include "pelage/error.h"
#include "pelage/fair.h"
#include "pelage/field.h"
#include "pelage/grow.h"
#include "pelage/io.h"
#include "pelage/measure.h"
#include "pelage/named_files.h"
#include "pelage/own_rates.h"
#include "pelage/progress.h"
#include "pelage/recipe.h"
#include "pelage/recipe_changes.h"
#include "pelage/render.h"
#include "pelage/unwrap.h"
