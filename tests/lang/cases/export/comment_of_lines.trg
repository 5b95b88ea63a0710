// How many posts
// the fence has.
export posts = 3;
//& exports.posts.doc = "How many posts the fence has."
