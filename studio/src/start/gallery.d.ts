// Pictures of the examples by name, as addresses: build.mjs makes the module of the files in pictures/.
declare module "gallery-pictures" {
    const pictures: Record<string, string>;
    export default pictures;
}
