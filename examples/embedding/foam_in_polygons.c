/* What a slicer does that lets Lamella fill its parts: it has polygons of each layer, and asks for the foam in
 * them. The foam's cells are graded by a function of this program. Prints a line a layer. */
#include <lamella.h>
#include <stdio.h>
#include <string.h>

/* Cells of 2 mm at the bottom and 4 mm at the top. */
static int32_t cell_size(void* user, const double* points, size_t count, double* values) {
    const double height = *(const double*)user;
    for (size_t i = 0; i < count; ++i) values[i] = 2 + 2 * (points[3 * i + 2] / height + 0.5);
    return LAMELLA_OK;
}

static int fail(const lamella_context* context) {
    lamella_error error = {.struct_size = sizeof error};
    if (context == NULL || lamella_last_error(context, &error) != LAMELLA_OK) return 3;
    fprintf(stderr, "%s: %s\n", lamella_status_name(error.status), error.message);
    return error.status;
}

/* The foam within a square frame of the plane at height z. */
static int32_t fill_frame(lamella_context* context, const lamella_job* job, double z) {
    const double points[] = {-9, -9, 9, -9, 9, 9, -9, 9, -4, -4, -4, 4, 4, 4, 4, -4};
    const size_t first[] = {0, 4, 8};
    const lamella_polygons frame = {
        .struct_size = sizeof frame, .count = 2, .first = first, .points = points};
    lamella_contours_view view = {.struct_size = sizeof view};
    lamella_section* section = NULL;
    lamella_contours* contours = NULL;
    int32_t status = lamella_section_open(context, job, z, &section);
    if (status == LAMELLA_OK)
        status = lamella_section_fill(context, section, LAMELLA_PART, &frame, 0.02, &contours);
    if (status == LAMELLA_OK) status = lamella_contours_view_get(context, contours, &view);
    if (status == LAMELLA_OK)
        printf("z %6.2f mm: %3zu contours, %7.2f mm2 of foam\n", z, view.count, view.area);
    lamella_contours_destroy(contours);
    lamella_section_destroy(section);
    return status;
}

int main(void) {
    static const char recipe_text[] =
        "[part]\nshape = \"box\"\nsize = [20, 20, 10]\n"
        "[foam]\ncell = \"wanted\"\ncell_min = 2\ncell_max = 4\nbeam = 0.3\n"
        "[layers]\nheight = 1\n";
    double height = 10;
    const lamella_grading wanted = {.struct_size = sizeof wanted,
                                    .least = 2,
                                    .greatest = 4,
                                    .values = cell_size,
                                    .user = &height,
                                    .identity = "2 to 4 mm over 10 mm"};
    lamella_job_info info = {.struct_size = sizeof info};
    lamella_context* context = NULL;
    lamella_recipe* recipe = NULL;
    lamella_job* job = NULL;
    int32_t status = lamella_context_create(LAMELLA_ABI_VERSION, &context);
    if (status == LAMELLA_OK) status = lamella_recipe_create(context, &recipe);
    if (status == LAMELLA_OK)
        status =
            lamella_recipe_add_text(context, recipe, recipe_text, strlen(recipe_text), "foam_in_polygons.c");
    if (status == LAMELLA_OK) status = lamella_recipe_add_grading(context, recipe, "wanted", &wanted);
    if (status == LAMELLA_OK) status = lamella_job_build(context, recipe, NULL, &job);
    if (status == LAMELLA_OK) status = lamella_job_info_get(context, job, &info);
    for (int32_t layer = 0; status == LAMELLA_OK && layer < info.layer_count; ++layer) {
        double z = 0;
        status = lamella_job_layer_z(context, job, layer, &z);
        if (status == LAMELLA_OK) status = fill_frame(context, job, z);
    }
    if (status != LAMELLA_OK) status = fail(context);
    lamella_job_destroy(job);
    lamella_recipe_destroy(recipe);
    lamella_context_destroy(context);
    return status;
}
