/* Calls the library very often, with recipes, seeds and heights by chance, and tells how its memory grows:
 *   many_calls [calls, default 100000]
 * Exit code 1 when it grew by more than a tenth and 4 MB from a tenth of the calls on. */
#include <lamella.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t state = 88172645463325252u;

static double chance(void) { /* xorshift64 (Marsaglia 2003) */
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) / 9007199254740992.0;
}

static long resident_kilobytes(void) {
    char line[256];
    long kilobytes = 0;
    FILE* file = fopen("/proc/self/status", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        if (sscanf(line, "VmRSS: %ld", &kilobytes) == 1) break;
    }
    if (file != NULL) fclose(file);
    return kilobytes;
}

static void must(int32_t status, const lamella_context* context) {
    lamella_error error = {.struct_size = sizeof error};
    if (status == LAMELLA_OK) return;
    lamella_last_error(context, &error);
    fprintf(stderr, "status %d: %s\n", (int)status, error.message);
    exit(2);
}

static lamella_job* build(lamella_context* context) {
    char text[512];
    lamella_recipe* recipe = NULL;
    lamella_job* job = NULL;
    const int size = snprintf(text, sizeof text,
                              "[part]\nshape = \"sphere\"\nradius = 3\n[foam]\ncell = 1.5\nbeam = 0.2\nseed = %d\n",
                              (int)(chance() * 1e9));
    must(lamella_recipe_create(context, &recipe), context);
    must(lamella_recipe_add_text(context, recipe, text, (size_t)size, "many_calls.c"), context);
    must(lamella_job_build(context, recipe, NULL, &job), context);
    lamella_recipe_destroy(recipe);
    return job;
}

/* Some calls fail on purpose: what they had begun must be released, too. */
static void fail_once(lamella_context* context, const lamella_job* job) {
    lamella_recipe* recipe = NULL;
    lamella_section* section = NULL;
    lamella_job* none = NULL;
    static const char wrong[] = "[part]\nshape = \"spear\"\n[foam]\ncell = \"x +\"\n";
    must(lamella_recipe_create(context, &recipe), context);
    must(lamella_recipe_add_text(context, recipe, wrong, sizeof wrong - 1, "wrong.toml"), context);
    if (lamella_job_build(context, recipe, NULL, &none) != LAMELLA_BAD_INPUT) exit(2);
    lamella_recipe_destroy(recipe);
    if (lamella_section_open(context, job, 1 / (chance() - chance()) * 1e308 * 10, &section) != LAMELLA_BAD_CALL)
        exit(2);
}

int main(int argc, char** argv) {
    const long calls = argc > 1 ? atol(argv[1]) : 100000;
    enum { pixels = 64, calls_a_job = 50 };
    static uint8_t mask[pixels * pixels];
    const lamella_raster raster = {.struct_size = sizeof raster,
                                   .columns = pixels,
                                   .rows = pixels,
                                   .lines = 2,
                                   .x = -3,
                                   .y = -3,
                                   .pitch_x = 6.0 / pixels,
                                   .pitch_y = 6.0 / pixels};
    lamella_context* context = NULL;
    lamella_job* job = NULL;
    long begin = 0, end = 0;
    double area = 0;
    must(lamella_context_create(LAMELLA_ABI_VERSION, &context), context);
    for (long i = 0; i < calls; ++i) {
        lamella_section* section = NULL;
        if (i % calls_a_job == 0) {
            lamella_job_destroy(job);
            job = build(context);
            fail_once(context, job);
        }
        must(lamella_section_open(context, job, 7 * chance() - 3.5, &section), context);
        if (i % 2 == 0) {
            lamella_contours_view view = {.struct_size = sizeof view};
            lamella_contours* contours = NULL;
            must(lamella_section_contours(context, section, LAMELLA_PART, 0.05, &contours), context);
            must(lamella_contours_view_get(context, contours, &view), context);
            area += view.area;
            lamella_contours_destroy(contours);
        } else {
            must(lamella_section_coverage(context, section, LAMELLA_PART, &raster, mask, 0), context);
        }
        lamella_section_destroy(section);
        if (i == calls / 10) begin = resident_kilobytes();
    }
    end = resident_kilobytes();
    lamella_job_destroy(job);
    lamella_context_destroy(context);
    printf("%ld calls, %.0f mm2: %ld kB of memory after a tenth of them, %ld kB at the end\n", calls, area, begin,
           end);
    return end > begin + begin / 10 && end > begin + 4096 ? 1 : 0;
}
