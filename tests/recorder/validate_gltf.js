// Prints what the glTF validator finds in a file: node validate_gltf.js PACKAGE FILE
const fs = require("fs");
const validator = require(process.argv[2]);

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[3])))
  .then((report) => console.log(JSON.stringify(report.issues)))
  .catch((error) => { console.error(String(error)); process.exit(1); });
