// SPDX-License-Identifier: GPL-3.0-or-later
// Journalled rows and a CSV complete after every write.
#include "engine/run/notebook.hpp"

#include <thread>
#include <vector>

#include "tests/support/run_fixture.hpp"

namespace asperity::notebook_test {
namespace {

using namespace std::chrono_literals;

class NotebookTest : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    journal = std::make_unique<Journal>(folder / "j.jsonl");
    book = std::make_unique<Notebook>("book", folder / "book.csv", *journal, log);
  }
  void write(std::vector<Entry> row) { book->write(row); }

  std::unique_ptr<Journal> journal;
  ExpectationLog log;
  std::unique_ptr<Notebook> book;
};

TEST_F(NotebookTest, MakesNoFileBeforeTheFirstRow) {
  book->declare_unit("Ra", "m");
  EXPECT_FALSE(std::filesystem::exists(folder / "book.csv"));
}

TEST_F(NotebookTest, RowIsInJournalAndFileAtOnce) {
  write({{"N", 1.0}, {"Ra", 1e-6, "m"}});
  EXPECT_EQ(content_of(folder / "book.csv"), "N,Ra [m]\n1,1e-06\n");
  EXPECT_EQ(content_of(folder / "j.jsonl"),
            "{\"n\":1,\"event\":\"row\",\"notebook\":\"book\",\"row\":{\"N\":1.0,\"Ra\":1e-06},\"units\":{"
            "\"Ra\":\"m\"}}\n");
  write({{"N", 2.0}});
  EXPECT_EQ(content_of(folder / "book.csv"), "N,Ra [m]\n1,1e-06\n2,\n");
  write({{"late", true}, {"N", 3.0}});
  EXPECT_EQ(content_of(folder / "book.csv"), "N,Ra [m],late\n1,1e-06,\n2,,\n3,,true\n");
}

TEST_F(NotebookTest, RefusedRowLeavesNoTrace) {
  write({{"Ra", 1e-6, "m"}});
  EXPECT_NE(error_of([&] { write({{"Ra", 1.0, "Pa"}}); }), "");
  EXPECT_EQ(book->table().rows(), 1U);
  EXPECT_EQ(journal->count(), 1);
}

TEST_F(NotebookTest, RowsOfManyThreadsAreAllThere) {
  constexpr int each = 100;
  std::vector<std::thread> writers;
  for (int t = 0; t < 4; ++t)
    writers.emplace_back([this, t] {
      for (int k = 0; k < each; ++k) write({{"t", static_cast<double>(t)}, {"k", static_cast<double>(k)}});
    });
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(book->table().rows(), 4U * each);
  EXPECT_EQ(content_of(folder / "book.csv"), book->table().csv());
}

TEST_F(NotebookTest, WritesAgainWhatTheDiskRefused) {
  write({{"a", 1.0}});
  // A missing folder fails reliably; a folder at the temporary name does not.
  std::filesystem::rename(folder / "book.csv", folder / "kept.csv");
  Notebook lost("lost", folder / "gone" / "lost.csv", *journal, log);
  const std::vector<Entry> row = {{"a", 1.0}};
  EXPECT_NE(error_of([&] { lost.write(row); }).find("no such file or directory"), std::string::npos);
  EXPECT_EQ(lost.table().rows(), 1U);
  EXPECT_EQ(journal->count(), 2);
  std::filesystem::create_directory(folder / "gone");
  EXPECT_TRUE(lost.save(1s));
  EXPECT_EQ(content_of(folder / "gone" / "lost.csv"), "a\n1\n");
  write({{"a", 2.0}});
  EXPECT_EQ(content_of(folder / "book.csv"), "a\n1\n2\n");
}

TEST_F(NotebookTest, ExpectationsEnterJournalAndLog) {
  write({{"mu", 0.4}});
  Expectation e;
  e.column = "mu";
  e.at_least = 0.5;
  e.label = "friction";
  EXPECT_FALSE(book->expect(e).passed);
  EXPECT_EQ(log.failed(), 1U);
  EXPECT_NE(
      content_of(folder / "j.jsonl").find("\"event\":\"expect\",\"notebook\":\"book\",\"passed\":false"),
      std::string::npos);
  e.at_least.reset();
  EXPECT_NE(error_of([&] { book->expect(e); }), "");
  EXPECT_EQ(log.verdicts().size(), 1U);
}

TEST_F(NotebookTest, WithoutAFileKeepsRowsInMemory) {
  Notebook memory("m", {}, *journal, log);
  const std::vector<Entry> row = {{"a", 1.0}};
  memory.write(row);
  EXPECT_EQ(memory.table().rows(), 1U);
  EXPECT_TRUE(memory.save(1s));
  EXPECT_EQ(files_in(folder), 1U);
}

// The resumed run is interrupted while it repeats rows.
TEST_F(NotebookTest, TheFileOfARunThatIsTakenUpNeverLosesARow) {
  write({{"N", 1.0}});
  write({{"N", 2.0}});
  const std::string two = content_of(folder / "book.csv");
  journal = Journal::again(folder / "j.jsonl");
  book = std::make_unique<Notebook>("book", folder / "book.csv", *journal, log);
  write({{"N", 1.0}});
  EXPECT_EQ(content_of(folder / "book.csv"), two);
  write({{"N", 2.0}});
  EXPECT_EQ(content_of(folder / "book.csv"), two);
  write({{"N", 3.0}, {"late", true}});
  EXPECT_EQ(content_of(folder / "book.csv"), "N,late\n1,\n2,\n3,true\n");
}

}  // namespace
}  // namespace asperity::notebook_test
